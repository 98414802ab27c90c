#pragma once

#include <Eigen/Geometry>
#include <functional>

#include "sensors/imu/module_angles.h"
#include "stereo_nav/core/trajectory.h"

namespace stereo_nav::imu {

/// What a perfect IMU would measure, and its true attitude.
struct MotionState {
  Eigen::Quaterniond q_world_imu = Eigen::Quaterniond::Identity();
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();     ///< rad/s, IMU frame
  Eigen::Vector3d linear_acceleration = Eigen::Vector3d::Zero();  ///< specific force, m/s^2, IMU frame
};

/// State at a time in seconds from the start.
using Motion = std::function<MotionState(double time_s)>;

/// Attitude as a function of time, without translation; rates by central differences.
Motion rotatingMotion(std::function<Eigen::Quaterniond(double)> attitude);

/// Starts at `start` and turns each angle at a constant rate (degrees per second, module's convention).
Motion constantRates(const ModuleAngles& start, const ModuleAngles& rates_deg_s);

/// Repeats a slow full turn about each of the IMU's axes, 12 s each, for the calibration of an accelerometer.
Motion slowTurns();

/// A robot driving about: yaw, pitch and roll swing with different periods.
Motion swaying();

/// Constant angles whose floats begin with the bytes `its`: the worst case of the angle protocol.
Motion headerInsideFloats();

/// Follows recorded poses of the IMU (at least two), interpolated, and stays at the last one; the
/// acceleration is that of the positions over 0.1 s.
Motion recordedMotion(Trajectory trajectory);

}  // namespace stereo_nav::imu
