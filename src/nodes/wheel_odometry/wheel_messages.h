#pragma once

#include <nav_msgs/Odometry.h>

#include <string>

#include "odometry/wheel/wheel_odometry.h"

namespace stereo_nav::nodes {

/// The pose with its covariance in the axes of `odom_frame`, the velocity in those of `base_frame`, as
/// nav_msgs/Odometry has them.
nav_msgs::Odometry toOdometry(const odometry::WheelOdometryResult& result, const std::string& odom_frame,
                              const std::string& base_frame);

}  // namespace stereo_nav::nodes
