#pragma once

#include <Eigen/Geometry>

namespace stereo_nav {

/// Returns the motion of base_link that moves the left camera by `T_start_camera`. Both poses are relative to
/// the start: of base_link in base_link's axes, of the camera in the camera's.
inline Eigen::Isometry3d basePose(const Eigen::Isometry3d& T_base_camera,
                                  const Eigen::Isometry3d& T_start_camera) {
  return T_base_camera * T_start_camera * T_base_camera.inverse();
}

}  // namespace stereo_nav
