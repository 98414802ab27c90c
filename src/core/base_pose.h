#pragma once

#include <Eigen/Geometry>

namespace stereo_nav {

/// The motion of base_link that moves the left camera by `T_start_camera`: both relative to where they
/// started, each in its own axes.
inline Eigen::Isometry3d basePose(const Eigen::Isometry3d& T_base_camera,
                                  const Eigen::Isometry3d& T_start_camera) {
  return T_base_camera * T_start_camera * T_base_camera.inverse();
}

}  // namespace stereo_nav
