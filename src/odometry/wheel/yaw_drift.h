#pragma once

#include <Eigen/Core>
#include <optional>

#include "kinematics/drive.h"
#include "odometry/wheel/wheel_odometry_params.h"

namespace stereo_nav::odometry {

/// The drift of the IMU's yaw - the bias of its gyroscope -, which shows while the wheels stand still: a
/// Kalman filter of one state. At rest is a base none of whose wheels has turned for half a second, unless
/// the IMU turns so fast that somebody turns the base by hand, or all encoders are dead.
class YawDrift {
 public:
  YawDrift(const WheelOdometryParams& params, const kinematics::Drive& drive);

  /// Takes an interval's increment of the yaw (nothing without an IMU) and whether any wheel turned.
  void add(bool wheels_turned, std::optional<double> yaw_rad, double duration_s);

  bool atRest() const { return at_rest_; }
  double rate_rad_per_s() const { return rate_rad_per_s_; }
  /// Of what is left when that rate is taken off.
  double variance() const { return variance_; }

 private:
  void measure();

  double prior_variance_;
  double yaw_variance_per_s_;  ///< rad^2/s, of the IMU
  double wheels_variance_;     ///< rad^2, of a turn that no counter shows
  double rate_rad_per_s_ = 0.0;
  double variance_;
  double still_s_ = 0.0;
  bool at_rest_ = false;
  double rest_yaw_rad_ = 0.0;  ///< turned by the IMU since the rest was measured last
  double rest_s_ = 0.0;
};

}  // namespace stereo_nav::odometry
