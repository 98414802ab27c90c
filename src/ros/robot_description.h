#pragma once

#include <geometry_msgs/TransformStamped.h>

#include <string>
#include <vector>

#include "core/rig_file.h"
#include "kinematics/drive_params.h"
#include "ros/base_bridge_params.h"

namespace stereo_nav::ros_io {

/// What the rig file says about the places of things. A transform is published by one node only: those that
/// never change by rig_transforms (fixedTransforms), those of wheels and servos by robot_state_publisher,
/// from joint_states and the URDF, which therefore holds nothing that is fixed.
struct RobotGeometry {
  Mounting mounting;
  kinematics::DriveParams drive;  ///< empty: the rig file has no section `drive`
  std::vector<BaseJointParams> joints;
  std::vector<BaseRangeParams> ranges;
  std::string base_frame = "base_link";
  std::string camera_frame, imu_frame;
  std::string laser_frame;  ///< empty: the rig file has no section `laser`
};

/// Sensors that do not move against the base, and the camera on the servo that carries it. Throws
/// ParameterError where two servos carry it.
std::vector<geometry_msgs::TransformStamped> fixedTransforms(const RobotGeometry& robot);

/// Base, wheels (links NAME_steering, NAME_wheel; the joints have the same names) and servos (joint NAME,
/// link NAME_link) as URDF.
std::string robotDescription(const RobotGeometry& robot);

}  // namespace stereo_nav::ros_io
