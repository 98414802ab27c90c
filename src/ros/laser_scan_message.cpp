#include "ros/laser_scan_message.h"

#include <fmt/format.h>

#include <cmath>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::ros_io {

odometry::LaserScan toLaserScan(const sensor_msgs::LaserScan& message) {
  const auto finite = [](float value) { return std::isfinite(value); };
  if (!finite(message.angle_min) || !finite(message.angle_increment) || message.angle_increment == 0.0F) {
    throw InputError(fmt::format(
        "a scan has angle_min {} and angle_increment {} rad; the driver must state the angles of its beams",
        message.angle_min, message.angle_increment));
  }
  if (!finite(message.time_increment) || message.time_increment < 0.0F) {
    throw InputError(fmt::format(
        "a scan has time_increment {} s; it must be 0 or more, the time from one beam to the next",
        message.time_increment));
  }
  if (!(message.range_max > message.range_min)) {
    throw InputError(
        fmt::format("a scan has range_min {} and range_max {} m; does the driver know its laser?",
                    message.range_min, message.range_max));
  }
  odometry::LaserScan scan;
  scan.time_s = message.header.stamp.toSec();
  scan.angle_min_rad = static_cast<double>(message.angle_min);
  scan.angle_increment_rad = static_cast<double>(message.angle_increment);
  scan.time_increment_s = static_cast<double>(message.time_increment);
  scan.range_min_m = static_cast<double>(message.range_min);
  scan.range_max_m = static_cast<double>(message.range_max);
  scan.ranges_m = message.ranges;
  return scan;
}

}  // namespace stereo_nav::ros_io
