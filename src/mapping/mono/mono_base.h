#pragma once

#include "mapping/mono/mono_slam.h"

namespace stereo_nav::mapping {

/// The pose of base_link in `odom`, in which base_link began with its axes.
struct UncertainBase {
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< position, rotation; axes of odom
};

/// Of a camera that is mounted at `T_base_camera` and whose world is its first pose.
UncertainBase basePoseOf(const MonoResult& result, const Eigen::Isometry3d& T_base_camera);

/// The covariance of a pose in the axes of the camera there, in those of base_link there.
Matrix6d atBase(const Matrix6d& camera_covariance, const Eigen::Isometry3d& T_base_camera);

}  // namespace stereo_nav::mapping
