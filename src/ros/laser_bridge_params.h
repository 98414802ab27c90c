#pragma once

#include <string>

#include "sensors/laser/laser_device.h"
#include "stereo_nav/core/parameter_visitor.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {

/// Parameters of the laser_bridge node: section `laser` of the rig file. Those of the device are among them,
/// without a section. Where the scanner sits is Mounting::laser.
struct LaserBridgeParams {
  std::string port = "/dev/ttyUSB0";
  std::string by_id_directory = "/dev/serial/by-id";
  std::string frame_id = ros_io::frames::kLaserLink;
  laser::LaserDeviceParams device;

  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::ros_io
