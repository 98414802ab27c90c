#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sensors/imu/emulation/emulated_module.h"
#include "sensors/imu/emulation/motion.h"

namespace stereo_nav::tools {

/// The time at which something begins and how long it lasts; it never happens unless given.
struct Interval {
  double start_s = -1.0;
  double duration_s = 0.0;
  bool contains(double time_s) const {
    return start_s >= 0.0 && time_s >= start_s && time_s < start_s + duration_s;
  }
};

struct EmulatorOptions {
  imu::Protocol protocol = imu::Protocol::kAngles;
  imu::AngleOrder order = imu::AngleOrder::kYawPitchRoll;
  bool magnetometer = false;
  double rate_hz = 100.0;
  int baud_rate = 115200;
  double batch_s = 0.016;
  double duration_s = 0.0;         ///< 0: until interrupted
  bool wait_for_reader = false;    ///< begin when the port is opened
  std::vector<std::string> links;  ///< names under which the port appears
  std::string replug_link;         ///< the first name after it was unplugged; empty: the same
  std::string log;                 ///< CSV of what was sent; empty: none
  std::string follow_topic;        ///< sensor_msgs/Imu to pass on; empty: `motion`
  imu::Motion motion;
  imu::ModuleErrors errors;
  unsigned seed = 1;
  double corrupt_probability = 0.0;
  double drop_probability = 0.0;
  double garbage_probability = 0.0;  ///< that a frame is followed by random bytes
  Interval pause, unplug;
};

/// Nothing when only help was asked for. Throws std::runtime_error (one line: what, why, what to do).
std::optional<EmulatorOptions> parseEmulatorOptions(int argc, char** argv);

}  // namespace stereo_nav::tools
