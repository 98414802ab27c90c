#pragma once

#include <geometry_msgs/Quaternion.h>
#include <sensor_msgs/Imu.h>

#include "nodes/imu_bridge/imu_bridge_node.h"

namespace stereo_nav::nodes {

geometry_msgs::Quaternion toMessage(const Eigen::Quaterniond& q);

/// With the standard deviations and the frame of `params`. What the module does not deliver is marked as
/// REP-145 and sensor_msgs/Imu ask: -1 in the first element of its covariance.
sensor_msgs::Imu toMessage(const imu::ImuEstimate& estimate, const ros_io::ImuBridgeParams& params,
                           ros::Time stamp);

}  // namespace stereo_nav::nodes
