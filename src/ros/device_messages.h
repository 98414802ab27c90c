#pragma once

#include <ros/time.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>

#include "ros/base_bridge_params.h"
#include "ros/laser_bridge_params.h"
#include "ros/range_bridge_params.h"
#include "sensors/base/controller/protocol.h"
#include "stereo_nav/WheelTicks.h"

namespace stereo_nav::ros_io {

// What the bridges publish of what their devices measure, and the simulator in their place.

/// Counters and measured steering angles, the latter only where a wheel is steered.
WheelTicks toWheelTicks(const base::Telemetry& telemetry, const kinematics::DriveParams& drive,
                        const std::string& frame, ros::Time stamp);

/// Positions of `NAME_wheel` and, where it is steered, `NAME_steering` of each wheel, and of the servos.
sensor_msgs::JointState toJointState(const base::Telemetry& telemetry, const kinematics::DriveParams& drive,
                                     const BaseBridgeParams& params, ros::Time stamp);

/// By REP-117: -infinity is too near, +infinity is nothing within the range, NaN is not
/// measured.
sensor_msgs::Range toRange(std::uint16_t range_mm, const BaseRangeParams& finder, ros::Time stamp);

sensor_msgs::BatteryState toBatteryState(std::uint16_t battery_mV, const BaseBridgeParams& params,
                                         ros::Time stamp);

/// The head turns clockwise: beams in the order of their times have falling angles.
sensor_msgs::LaserScan toMessage(const laser::Scan& scan, const LaserBridgeParams& params, ros::Time stamp);

/// `range_m` by REP-117.
sensor_msgs::Range toMessage(double range_m, const RangeFinderParams& finder, ros::Time stamp);

}  // namespace stereo_nav::ros_io
