#pragma once

#include <string>

#include "sensors/imu/imu_device.h"
#include "sensors/imu/imu_estimator.h"
#include "stereo_nav/core/parameter_visitor.h"
#include "stereo_nav/sensors/imu/calibration.h"

namespace stereo_nav::ros_io {

/// Parameters of the imu_bridge node. Those of the device are among them, without a section.
struct ImuBridgeParams {
  std::string port = "/dev/ttyUSB0";
  std::string by_id_directory = "/dev/serial/by-id";
  std::string frame_id = "imu_link";
  std::string calibration_file;
  bool chatter = false;
  double rate_window_s = 0.02;
  double tilt_stddev_rad = 0.01;
  double yaw_stddev_rad = 0.05;
  double angular_velocity_stddev_rad_s = 0.02;
  double linear_acceleration_stddev_m_s2 = 0.1;
  imu::ImuDeviceParams device;
  imu::AttitudeParams filter;
  imu::GyroCalibrationParams gyro_calibration;

  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::ros_io
