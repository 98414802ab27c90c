#include "ros/laser_bridge_params.h"

namespace stereo_nav::ros_io {

void LaserBridgeParams::describe(ParameterVisitor& visitor) {
  visitor.text("port", port, "serial port, better by its lasting name /dev/serial/by-id/...");
  visitor.text("by_id_directory", by_id_directory, "folder of lasting names of serial ports");
  visitor.text("frame_id", frame_id, "frame of the scanner: x along its own zero, z upwards");
  device.describe(visitor);
}

}  // namespace stereo_nav::ros_io
