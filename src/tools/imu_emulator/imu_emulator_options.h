#pragma once

#include <optional>
#include <string>

#include "sensors/imu/emulation/datagram_line.h"
#include "sensors/imu/emulation/emulated_module.h"
#include "sensors/imu/emulation/motion.h"
#include "tools/common/emulator_options.h"

namespace stereo_nav::tools {

struct EmulatorOptions {
  imu::Protocol protocol = imu::Protocol::kAngles;
  imu::AngleOrder order = imu::AngleOrder::kYawPitchRoll;
  bool magnetometer = false;
  double rate_hz = 100.0;
  std::string follow_topic;  ///< sensor_msgs/Imu to pass on; empty: `motion`
  imu::Motion motion;
  imu::ModuleErrors errors;
  EmulatorRunOptions run;
  std::optional<imu::DatagramOptions> udp;  ///< nothing: a serial port
};

/// Nothing when only help was asked for. Throws std::runtime_error (one line: what, why, what to do).
std::optional<EmulatorOptions> parseEmulatorOptions(int argc, char** argv);

}  // namespace stereo_nav::tools
