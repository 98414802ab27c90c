#include "stereo_nav/calibration/stereo_rig.h"

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/calib3d.hpp>

namespace stereo_nav::calibration {
namespace {

/// OpenCV's default of five iterations leaves 0.01 px in the corners of a wide lens.
const cv::TermCriteria kExactly(cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 50, 1e-9);

std::vector<cv::Point2d> undistorted(const CameraModel& camera, const std::vector<cv::Point2d>& raw_px,
                                     const cv::Matx33d& R, const cv::Matx34d& P) {
  std::vector<cv::Point2d> result;
  if (raw_px.empty()) return result;
  if (camera.equidistant) {
    cv::fisheye::undistortPoints(raw_px, result, camera.K, camera.D, R, P);
  } else {
    cv::undistortPoints(raw_px, result, camera.K, camera.D, R, P, kExactly);
  }
  return result;
}

double angleBetween(const CameraModel& camera, const cv::Point2d& first, const cv::Point2d& second) {
  const auto rays = camera.rays({first, second});
  const Eigen::Vector3d a(rays[0].x, rays[0].y, 1.0), b(rays[1].x, rays[1].y, 1.0);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

std::vector<cv::Point2d> CameraModel::rays(const std::vector<cv::Point2d>& raw_px) const {
  return undistorted(*this, raw_px, cv::Matx33d::eye(), cv::Matx34d::eye());
}

std::vector<Eigen::Vector2d> CameraModel::rectify(const std::vector<cv::Point2f>& raw_px) const {
  std::vector<Eigen::Vector2d> result;
  for (const cv::Point2d& pixel : undistorted(*this, {raw_px.begin(), raw_px.end()}, R, P))
    result.emplace_back(pixel.x, pixel.y);
  return result;
}

double CameraModel::horizontalView_rad() const {
  const double middle = 0.5 * (size.height - 1);
  return angleBetween(*this, {-0.5, middle}, {size.width - 0.5, middle});
}

double CameraModel::verticalView_rad() const {
  const double middle = 0.5 * (size.width - 1);
  return angleBetween(*this, {middle, -0.5}, {middle, size.height - 0.5});
}

double rectifiedView_rad(double focal_length_px, double centre_px, int size_px) {
  return std::atan((centre_px + 0.5) / focal_length_px) +
         std::atan((size_px - 0.5 - centre_px) / focal_length_px);
}

}  // namespace stereo_nav::calibration
