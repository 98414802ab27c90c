#pragma once

#include <Eigen/Geometry>

namespace stereo_nav {

/// Pose of base_link in `odom`, from the pose of the left camera in its own start. `odom` is base_link at the
/// start.
inline Eigen::Isometry3d basePose(const Eigen::Isometry3d& T_base_camera,
                                  const Eigen::Isometry3d& T_start_camera) {
  return T_base_camera * T_start_camera * T_base_camera.inverse();
}

}  // namespace stereo_nav
