#pragma once

#include <string>

#include "core/rig_file.h"
#include "kinematics/drive_params.h"

namespace stereo_nav::odometry {

/// Parameters of the wheel odometry: the drive, the encoders' counters, and the sizes of the errors.
struct WheelOdometryParams {
  kinematics::DriveParams drive;
  int counter_bits = 32;
  double pulse_sigma = 0.3;
  double slip_sigma_m = 0.003;
  double scale_sigma = 0.005;
  double yaw_sigma_rad = 0.0005;
  double yaw_drift_sigma_rad_per_s = 0.0005;
  double speed_window_s = 0.1;
  bool as_published = false;

  /// Of the place that one reading of a wheel's counter gives, m^2.
  double readingVariance_m2(const kinematics::WheelParams& wheel) const;
  /// Of what a wheel slips while it rolls so far, m^2.
  double slipVariance_m2(double distance_m) const;

  /// All but the drive, which has a section of its own in the rig file.
  void describe(ParameterVisitor& visitor);
};

/// Parameters from a file like config/wheel.yaml (none where its path is empty), overlaid by the sections
/// `wheel_odometry` and `drive` of the rig file. Throws ParameterError.
WheelOdometryParams loadWheelOdometry(const std::string& config_path, const RigFile& rig);

}  // namespace stereo_nav::odometry
