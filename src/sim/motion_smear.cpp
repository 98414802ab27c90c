#include "sim/motion_smear.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace stereo_nav::sim {

Eigen::Vector2d turnedBy(const CameraCalibration& calibration, const Eigen::Matrix3d& R_world_first,
                         const Eigen::Matrix3d& R_world_last) {
  const Eigen::Vector3d ray = R_world_last.transpose() * R_world_first.col(2);
  return (calibration.K * (ray / ray.z())).head<2>() - calibration.K.col(2).head<2>();
}

cv::Mat smeared(const cv::Mat& light, const Eigen::Vector2d& step_px) {
  constexpr int kPoints = 64;  // along the way, each shared out to its four pixels
  const int half_x = static_cast<int>(std::ceil(0.5 * std::fabs(step_px.x())));
  const int half_y = static_cast<int>(std::ceil(0.5 * std::fabs(step_px.y())));
  cv::Mat kernel = cv::Mat::zeros(2 * half_y + 1, 2 * half_x + 1, CV_32FC1);
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector2d at = ((i + 0.5) / kPoints - 0.5) * step_px + Eigen::Vector2d(half_x, half_y);
    const int x = std::min(static_cast<int>(at.x()), std::max(0, kernel.cols - 2));
    const int y = std::min(static_cast<int>(at.y()), std::max(0, kernel.rows - 2));
    const double fx = at.x() - x, fy = at.y() - y;
    for (int dy = 0; dy < std::min(2, kernel.rows); ++dy) {
      for (int dx = 0; dx < std::min(2, kernel.cols); ++dx) {
        const double share = (dx == 0 ? 1.0 - fx : fx) * (dy == 0 ? 1.0 - fy : fy);
        kernel.at<float>(y + dy, x + dx) += static_cast<float>(share / kPoints);
      }
    }
  }
  cv::Mat result;
  cv::filter2D(light, result, -1, kernel, cv::Point(-1, -1), 0.0, cv::BORDER_REPLICATE);
  return result;
}

}  // namespace stereo_nav::sim
