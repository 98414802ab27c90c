#pragma once

#include <ros/time.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Range.h>

#include "ros/base_bridge_params.h"
#include "sensors/base/controller/protocol.h"
#include "stereo_nav/WheelTicks.h"

namespace stereo_nav::nodes {

/// Counters and measured steering angles, the latter only where a wheel is steered.
WheelTicks toWheelTicks(const base::Telemetry& telemetry, const kinematics::DriveParams& drive,
                        const std::string& frame, ros::Time stamp);

/// Positions of `NAME_wheel` and, where it is steered, `NAME_steering` of each wheel, and of the servos.
sensor_msgs::JointState toJointState(const base::Telemetry& telemetry, const kinematics::DriveParams& drive,
                                     const ros_io::BaseBridgeParams& params, ros::Time stamp);

/// By REP-117: -infinity is too near, +infinity is nothing within the range, NaN is not
/// measured.
sensor_msgs::Range toRange(std::uint16_t range_mm, const ros_io::BaseRangeParams& finder, ros::Time stamp);

sensor_msgs::BatteryState toBatteryState(std::uint16_t battery_mV, const ros_io::BaseBridgeParams& params,
                                         ros::Time stamp);

}  // namespace stereo_nav::nodes
