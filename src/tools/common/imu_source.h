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
  /// After parsing. Throws ParameterError.
  void finish();

  /// Reads until `keepGoing` says no (asked every 0.1 s) or SIGINT comes; faults of the line go to stderr
  /// when they begin.
  imu::ImuDeviceStatus read(const std::function<bool()>& keep_going, const imu::ImuDevice::Sink& sink) const;
};

}  // namespace stereo_nav::tools
