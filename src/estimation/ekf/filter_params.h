#pragma once

#include "estimation/ekf/measurement.h"
#include "estimation/ekf/prediction.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::estimation {

/// Parameters of the filter itself. Names that robot_localization has, too, mean the same here.
struct FilterParams {
  double gravity_m_s2 = 9.80665;
  bool rewind = true;
  double history_s = 2.0;
  double history_megabytes = 4.0;
  bool reset_on_time_jump = false;
  bool zero_velocity_updates = true;
  double gate_share = 0.999;
  double gyro_bias_sigma_rad_s = 0.01;
  double accelerometer_bias_sigma_m_s2 = 0.3;
  double wheel_scale_sigma = 0.1;
  double wheel_turn_per_way_sigma_rad_m = 0.05;
  double wheel_drift_sigma = 0.015;
  double acceleration_noise_m_s2 = 0.7;
  double turn_acceleration_noise_rad_s2 = 1.0;
  double jerk_noise_m_s3 = 10.0;
  double gyro_bias_walk_rad_s2 = 2e-5;
  double accelerometer_bias_walk_m_s3 = 1e-3;
  double wheel_scale_walk = 3e-4;
  DefaultSigmas defaults;
  /// Variances a second and at the start of the fifteen parts x y z, roll pitch yaw, their rates,
  /// accelerations, where the file holds robot_localization's matrices.
  std::optional<Eigen::Matrix<double, 15, 1>> process_noise;
  std::optional<Eigen::Matrix<double, 15, 1>> initial_variance;
  std::optional<Eigen::Matrix<double, 15, 1>> initial_state;

  void describe(ParameterVisitor& visitor);
  ProcessNoise noise() const;
  /// Variances of the wheels' scales at the start.
  WheelScales scaleVariances() const;
};

}  // namespace stereo_nav::estimation
