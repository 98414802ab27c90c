#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "odometry/wheel/interval_motion.h"

namespace stereo_nav::odometry {

/// One interval with what was found of it.
struct WheelStep {
  WheelInterval interval;
  IntervalMotion motion;
  double duration_s = 0.0;
  std::vector<double> slip_variance_m2;  ///< of each wheel
  double yaw_drift_variance = 0.0;       ///< rad^2/s^2, of the drift that is left in the IMU's yaw
};

/// Covariance of a pose that is composed of intervals, for an error in the axes of the base: T = T_estimated
/// exp(e). Three kinds of error are told apart, since they add up differently:
/// * slip is new in every interval: variances add;
/// * the error of a counter's reading enters two neighbouring intervals with opposite signs: on a straight
/// way the first
///   and the last reading alone count;
/// * radii and the drift of the yaw stay wrong: the errors themselves add, and the variance grows with the
/// square. A drift that is measured while the base rests is wrong by less from there on; what it has done to
/// the pose stays.
class PlanarCovariance {
 public:
  /// `scale_sigma` is the relative error of each wheel's radius.
  PlanarCovariance(std::size_t wheels, double scale_sigma);

  /// Starts anew from a pose with this covariance (axes of the base).
  void reset(const Eigen::Matrix3d& covariance);

  /// `reading_variance_m2` of each wheel, of one reading.
  void append(const WheelStep& step, const std::vector<double>& reading_variance_m2);

  Eigen::Matrix3d covariance() const;

 private:
  double scale_variance_;
  Eigen::Matrix3d random_ = Eigen::Matrix3d::Zero();  ///< from slip, readings and the IMU
  WheelColumns with_reading_;  ///< covariance of the pose and each wheel's last reading
  WheelColumns scale_gain_;    ///< d pose / d relative error of each radius
  Eigen::Vector3d with_drift_ = Eigen::Vector3d::Zero();  ///< covariance of the pose and the drift
  double drift_variance_ = 0.0;                           ///< of the last interval
};

}  // namespace stereo_nav::odometry
