#pragma once

#include <Eigen/Geometry>
#include <string>

#include "stereo_nav/SetPose.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::ros_io {

/// A request of the services `vo/set_pose` and `wheel/set_pose`, read and checked.
struct SetPoseRequest {
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();
  std::string refusal;  ///< why the request cannot be used; empty if it can
};

/// The pose must be in `odom_frame`, or name no frame.
SetPoseRequest readSetPose(const SetPose::Request& request, const std::string& odom_frame);

}  // namespace stereo_nav::ros_io
