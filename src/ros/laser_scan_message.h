#pragma once

#include <sensor_msgs/LaserScan.h>

#include "odometry/laser/laser_scan.h"

namespace stereo_nav::ros_io {

/// Throws InputError for a message whose angles, ranges or times are no scan.
odometry::LaserScan toLaserScan(const sensor_msgs::LaserScan& message);

}  // namespace stereo_nav::ros_io
