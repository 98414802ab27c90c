#pragma once

#include <geometry_msgs/Quaternion.h>
#include <sensor_msgs/Imu.h>

#include "nodes/imu_bridge/imu_bridge_node.h"

namespace stereo_nav::nodes {

geometry_msgs::Quaternion toMessage(const Eigen::Quaterniond& q);

/// Makes a message with the standard deviations and the frame of `params`. Quantities that the module does
/// not deliver have -1 as the first element of their covariance, as REP-145 and sensor_msgs/Imu prescribe.
sensor_msgs::Imu toMessage(const imu::ImuEstimate& estimate, const ros_io::ImuBridgeParams& params,
                           ros::Time stamp);

}  // namespace stereo_nav::nodes
