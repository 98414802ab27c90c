#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace stereo_nav::vision {

/// Geometry of a rectified stereo pair, as in the projection matrices P of the two camera_infos:
///   P_left = [fx 0 cx 0; 0 fy cy 0; 0 0 1 0],  P_right = [fx 0 right_cx -fx*baseline; 0 fy cy 0; 0 0 1 0].
/// Points are in the left optical frame (x right, y down, z forward), metres. Pixels count from the centre of
/// the upper left one. Disparity is x_left - x_right with the offset of the principal points already taken
/// out: d = (x_left - cx) - (x_right - right_cx), so that z = fx * baseline / d always holds.
struct StereoCalibration {
  double fx = 0.0;          ///< px
  double fy = 0.0;          ///< px
  double cx = 0.0;          ///< px, left camera
  double cy = 0.0;          ///< px
  double right_cx = 0.0;    ///< px, equals cx for cameras that were rectified to zero disparity at infinity
  double baseline_m = 0.0;  ///< > 0
  int width = 0;            ///< px
  int height = 0;           ///< px
  /// Row of the raw image that each pixel comes from, CV_32FC1; empty: its own row. Rolling shutters count
  /// there.
  cv::Mat left_raw_rows;
  cv::Mat right_raw_rows;  ///< the same of the right image

  /// Throws std::invalid_argument that says which value is impossible (NaN, no baseline, no size).
  void validate() const;

  /// Point of a pixel with its disparity; `disparity_px` must be > 0. [X Y Z W] = Q [x y d 1] (thesis, eq.
  /// 2-8).
  Eigen::Vector3d backProject(double x, double y, double disparity_px) const {
    const double z = fx * baseline_m / disparity_px;
    return {(x - cx) / fx * z, (y - cy) / fy * z, z};
  }

  /// (x_left, y, x_right) in px of a point with z > 0.
  Eigen::Vector3d project(const Eigen::Vector3d& p_camera) const {
    const double inverse_z = 1.0 / p_camera.z();
    return {fx * p_camera.x() * inverse_z + cx, fy * p_camera.y() * inverse_z + cy,
            fx * (p_camera.x() - baseline_m) * inverse_z + right_cx};
  }
};

}  // namespace stereo_nav::vision
