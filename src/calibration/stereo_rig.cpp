#include "stereo_nav/calibration/stereo_rig.h"

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/calib3d.hpp>

namespace stereo_nav::calibration {
namespace {

/// OpenCV's default of five iterations leaves 0.01 px in the corners of a wide lens.
const cv::TermCriteria kExactly(cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 50, 1e-9);

double angleBetween(const CameraModel& camera, const cv::Point2f& first, const cv::Point2f& second) {
  std::vector<cv::Point2f> rays;
  cv::undistortPoints(std::vector<cv::Point2f>{first, second}, rays, camera.K, camera.D, cv::noArray(),
                      cv::noArray(), kExactly);
  const Eigen::Vector3d a(rays[0].x, rays[0].y, 1.0), b(rays[1].x, rays[1].y, 1.0);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

std::vector<Eigen::Vector2d> CameraModel::rectify(const std::vector<cv::Point2f>& raw_px) const {
  std::vector<cv::Point2d> raw(raw_px.begin(), raw_px.end()), rectified;
  if (raw.empty()) return {};
  cv::undistortPoints(raw, rectified, K, D, R, P, kExactly);
  std::vector<Eigen::Vector2d> result;
  for (const cv::Point2d& pixel : rectified) result.emplace_back(pixel.x, pixel.y);
  return result;
}

double CameraModel::horizontalView_rad() const {
  const auto middle = static_cast<float>(0.5 * (size.height - 1));
  return angleBetween(*this, {-0.5f, middle}, {static_cast<float>(size.width) - 0.5f, middle});
}

double CameraModel::verticalView_rad() const {
  const auto middle = static_cast<float>(0.5 * (size.width - 1));
  return angleBetween(*this, {middle, -0.5f}, {middle, static_cast<float>(size.height) - 0.5f});
}

double rectifiedView_rad(double focal_length_px, double centre_px, int size_px) {
  return std::atan((centre_px + 0.5) / focal_length_px) +
         std::atan((size_px - 0.5 - centre_px) / focal_length_px);
}

}  // namespace stereo_nav::calibration
