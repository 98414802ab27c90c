#include "ros/imu_bridge_params.h"

namespace stereo_nav::ros_io {

void ImuBridgeParams::describe(ParameterVisitor& visitor) {
  visitor.text(
      "port", port,
      "serial port, better by its lasting name /dev/serial/by-id/...; udp:5555 or udp:ADDRESS:5555 receives UDP, "
      "without ADDRESS from this computer alone");
  visitor.text("by_id_directory", by_id_directory, "folder of lasting names of serial ports");
  visitor.text("frame_id", frame_id, "frame of the module: x forward, y left, z up");
  visitor.text("calibration_file", calibration_file,
               "calibration of a raw module, read at the start, written by imu/calibrate_gyro; may be empty");
  visitor.flag("chatter", chatter, "publish the module's angles as text on chatter");
  visitor.real("rate_window_s", rate_window_s, {0.001, 1.0}, "s",
               "angle module: time over which angles are differentiated");
  visitor.real("tilt_stddev_rad", tilt_stddev_rad, {1e-6, 3.2}, "rad",
               "standard deviation of roll and pitch, for the covariance", Change::kLive);
  visitor.real("yaw_stddev_rad", yaw_stddev_rad, {1e-6, 3.2}, "rad",
               "standard deviation of yaw, for the covariance", Change::kLive);
  visitor.real("angular_velocity_stddev_rad_s", angular_velocity_stddev_rad_s, {1e-6, 10.0}, "rad/s",
               "standard deviation of the angular velocity, for the covariance", Change::kLive);
  visitor.real("linear_acceleration_stddev_m_s2", linear_acceleration_stddev_m_s2, {1e-6, 100.0}, "m/s^2",
               "standard deviation of the linear acceleration, for the covariance", Change::kLive);
  device.describe(visitor);
  visitSection(visitor, "filter", filter);
  visitSection(visitor, "gyro_calibration", gyro_calibration);
}

}  // namespace stereo_nav::ros_io
