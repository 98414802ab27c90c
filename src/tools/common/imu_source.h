#pragma once

#include <boost/program_options.hpp>
#include <functional>
#include <string>

#include "sensors/imu/imu_device.h"

namespace stereo_nav::tools {

/// The options of every program that reads a module itself.
struct ImuSource {
  std::string port;
  imu::ImuDeviceParams device;
  std::string protocol = "angles";
  std::string angle_order = "yaw_pitch_roll";

  void addOptions(boost::program_options::options_description& options);
  /// To be called after parsing. Throws ParameterError.
  void finish();

  /// Reads until `keepGoing` (asked every 0.1 s) returns false or SIGINT comes. Faults of the line are
  /// written to stderr when they begin.
  imu::ImuDeviceStatus read(const std::function<bool()>& keep_going, const imu::ImuDevice::Sink& sink) const;
};

}  // namespace stereo_nav::tools
