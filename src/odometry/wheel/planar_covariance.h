#pragma once

#include <Eigen/Core>
#include <vector>

#include "odometry/wheel/interval_motion.h"

namespace stereo_nav::odometry {

/// Standard deviations of the errors that stay the same on the whole way.
struct ConstantErrors {
  double scale = 0.0;                ///< relative, of each wheel's radius
  double yaw_drift_rad_per_s = 0.0;  ///< of the IMU
};

/// Covariance of a pose that is composed of intervals, for an error in the axes of the base: T = T_estimated
/// exp(e). Three kinds of error are told apart, since they add up differently:
/// * slip is new in every interval: variances add;
/// * the error of a counter's reading enters two neighbouring intervals with opposite signs: on a straight
/// way the first
///   and the last reading alone count;
/// * radii and the drift of the yaw stay wrong: the errors themselves add, and the variance grows with the
/// square.
class PlanarCovariance {
 public:
  PlanarCovariance(std::size_t wheels, const ConstantErrors& errors);

  /// Starts anew from a pose with this covariance (axes of the base).
  void reset(const Eigen::Matrix3d& covariance);

  /// `slip_variance_m2` and `reading_variance_m2` of each wheel, the latter of one reading.
  void append(const WheelInterval& interval, const IntervalMotion& motion, double duration_s,
              const std::vector<double>& slip_variance_m2, const std::vector<double>& reading_variance_m2);

  Eigen::Matrix3d covariance() const;

 private:
  ConstantErrors errors_;
  Eigen::Matrix3d random_ = Eigen::Matrix3d::Zero();  ///< from slip and readings
  WheelColumns with_reading_;  ///< covariance of the pose and each wheel's last reading
  WheelColumns scale_gain_;    ///< d pose / d relative error of each radius
  Eigen::Vector3d drift_gain_ = Eigen::Vector3d::Zero();
};

}  // namespace stereo_nav::odometry
