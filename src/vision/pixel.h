#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace stereo_nav::vision {

/// Pixels as the image functions take them and as geometry does.
inline cv::Point2f toCv(const Eigen::Vector2d& px) {
  return {static_cast<float>(px.x()), static_cast<float>(px.y())};
}

inline Eigen::Vector2d toEigen(const cv::Point2f& px) {
  return {static_cast<double>(px.x), static_cast<double>(px.y)};
}

}  // namespace stereo_nav::vision
