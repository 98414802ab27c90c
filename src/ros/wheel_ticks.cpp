#include "ros/wheel_ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::ros_io {
namespace {

std::vector<std::string> namesOf(const kinematics::DriveParams& drive) {
  std::vector<std::string> names;
  for (const auto& wheel : drive.wheels) names.push_back(wheel.name);
  return names;
}

/// For each wheel of the drive its place in the message.
std::vector<std::size_t> placesOf(const WheelTicks& message, const kinematics::DriveParams& drive) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < drive.wheels.size(); ++i) {
    if (message.names.empty()) {
      places.push_back(i);
      continue;
    }
    const auto found = std::find(message.names.begin(), message.names.end(), drive.wheels[i].name);
    if (found == message.names.end() || message.names.size() != drive.wheels.size()) {
      throw InputError(fmt::format("wheel_ticks has the wheels {}, the rig file {}; give both the same names",
                                   fmt::join(message.names, ", "), fmt::join(namesOf(drive), ", ")));
    }
    places.push_back(static_cast<std::size_t>(found - message.names.begin()));
  }
  return places;
}

}  // namespace

odometry::WheelSample toWheelSample(const WheelTicks& message, const kinematics::DriveParams& drive) {
  const std::size_t wheels = drive.wheels.size();
  const bool has_angles = !message.steering_rad.empty();
  if (message.pulses.size() != wheels || (has_angles && message.steering_rad.size() != wheels)) {
    throw InputError("wheel_ticks holds " + std::to_string(message.pulses.size()) + " counters and " +
                     std::to_string(message.steering_rad.size()) + " steering angles, the rig file has " +
                     std::to_string(wheels) + " wheels; is its section `drive` that of this robot?");
  }
  odometry::WheelSample sample;
  sample.time_s = message.header.stamp.toSec();
  for (const std::size_t place : placesOf(message, drive)) {
    sample.pulses.push_back(message.pulses[place]);
    if (!has_angles) continue;
    sample.steering_rad.push_back(message.steering_rad[place]);
    if (!std::isfinite(sample.steering_rad.back()))
      throw InputError("wheel_ticks holds a steering angle that is no number; its driver is at fault");
  }
  return sample;
}

}  // namespace stereo_nav::ros_io
