#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace stereo_nav::mapping {

/// A pixel with its derivative by the point it shows.
struct ProjectedPoint {
  Eigen::Vector2d px;
  Eigen::Matrix<double, 2, 3> by_point;
};

/// A pinhole camera, or the wide-angle camera of MonoSLAM (Davison, Reid, Molton and Stasse 2007, section
/// 3.2.1; SceneLib): with u the pinhole's pixel from the centre, r = |u|, the lens shows it at
/// u / sqrt(1 + 2 k r^2). `k` is 0 for rectified images. Optical axes: x right, y down, z forward.
struct MonoCamera {
  double fx = 0.0;  ///< px
  double fy = 0.0;  ///< px
  double cx = 0.0;  ///< px from the centre of the upper left pixel
  double cy = 0.0;
  double k = 0.0;  ///< 1/px^2, not negative
  cv::Size size;   ///< of the image

  /// Nothing for a point that is not before the camera.
  std::optional<ProjectedPoint> project(const Eigen::Vector3d& p_camera) const;
  /// The ray (x/z, y/z, 1) seen at a pixel. Of the wide-angle camera, pixels beyond its rim (2 k r^2 >= 1)
  /// have the ray of the rim.
  Eigen::Vector3d ray(const Eigen::Vector2d& px) const;
  /// Derivative of (x/z, y/z) by the pixel.
  Eigen::Matrix2d rayByPixel(const Eigen::Vector2d& px) const;
  /// Whether the pixel keeps `margin_px` from the edges.
  bool sees(const Eigen::Vector2d& px, double margin_px) const;
};

}  // namespace stereo_nav::mapping
