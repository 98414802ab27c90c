#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

namespace stereo_nav::navigation {

/// The left camera of a rectified pair, and where it sits: z = fx baseline / d, as vision::StereoCalibration
/// has it.
struct DisparityCamera {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< px
  double baseline_m = 0.0;
  Eigen::Isometry3d T_base_camera =
      Eigen::Isometry3d::Identity();  ///< optical axes; base_link is on the floor
  double right_shift_px = 0.0;        ///< right_cx - cx
};

/// The floor as a disparity image shows it: a plane there, too. A pixel's disparity on the floor is linear in
/// its place, and the height of what is seen at disparity d above the floor is h (1 - d_floor / d) (Labayrade
/// 2002, "v-disparity").
struct FloorPlane {
  Eigen::Vector3d coefficients = Eigen::Vector3d::Zero();  ///< d_floor = (u, v, 1) . coefficients, px
  double height_m = 0.0;                                   ///< of the camera

  double disparity(double u, double v) const { return coefficients.dot(Eigen::Vector3d(u, v, 1.0)); }
  /// The row in which column `u` shows the floor at a disparity.
  double row(double u, double d) const {
    return (d - coefficients.x() * u - coefficients.z()) / coefficients.y();
  }
};

/// The floor at z = 0 of base_link, by the mounting of the camera.
FloorPlane floorOf(const DisparityCamera& camera);

/// The floor that the image shows: least squares over pixels near the expected floor, from wide to narrow
/// gates. Where there are too few of them, or they tilt it by more than `max_tilt_rad`, the expected one.
/// `disparity`: CV_32FC1, px, at most 0 where unknown.
FloorPlane estimatedFloor(const cv::Mat& disparity, const DisparityCamera& camera, const FloorPlane& expected,
                          double max_tilt_rad);

}  // namespace stereo_nav::navigation
