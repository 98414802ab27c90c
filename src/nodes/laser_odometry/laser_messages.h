#pragma once

#include <nav_msgs/Odometry.h>

#include <string>

#include "nodes/laser_odometry/laser_session.h"
#include "stereo_nav/LaserStatus.h"

namespace stereo_nav::nodes {

/// The pose with its covariance in the axes of `odom_frame`, the velocity in those of `base_frame`, as
/// nav_msgs/Odometry has them; stamped as the scan is.
nav_msgs::Odometry toOdometry(const LaserReading& reading, const std::string& odom_frame,
                              const std::string& base_frame);

LaserStatus toStatus(const LaserReading& reading, const ScanCounts& counts, const std::string& laser_frame);

}  // namespace stereo_nav::nodes
