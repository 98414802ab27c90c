#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinematics/drive.h"

namespace stereo_nav::odometry {

constexpr int kMostWheels = 16;

/// One column a wheel.
using WheelColumns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMostWheels>;

/// What was measured between two readings of the counters.
struct WheelInterval {
  std::vector<double> distance_m;    ///< rolled by each circumference
  std::vector<double> variance_m2;   ///< of each distance; a wheel with an infinite one is left out
  std::vector<double> steering_rad;  ///< mean of the interval; empty without steered wheels
  std::optional<double> yaw_rad;     ///< increment of the IMU's yaw
  double yaw_variance_rad2 = 0.0;
};

/// Motion of the base in one interval, as the twist of an arc: exp(motion) takes its start to its end.
struct IntervalMotion {
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();  ///< forward m, left m, counterclockwise rad
  WheelColumns gain;                                 ///< d motion / d distance of each wheel
  Eigen::Vector3d yaw_gain = Eigen::Vector3d::Zero();
  Eigen::Matrix3d sideways_covariance = Eigen::Matrix3d::Zero();  ///< from wheels that slide sideways
  double squared_residual = 0.0;  ///< normalised; chi-square distributed with `redundancy` degrees of freedom
  int redundancy = 0;
};

/// The steering angle halfway between two readings, taken the short way round.
double meanSteering_rad(double from_rad, double to_rad);

/// Weighted least squares over the rows of all wheels and the yaw. The motion is zero where the wheels that
/// are not left out do not determine it.
IntervalMotion solveInterval(const kinematics::Drive& drive, const WheelInterval& interval);

}  // namespace stereo_nav::odometry
