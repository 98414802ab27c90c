#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/drive.h"
#include "odometry/wheel/encoder_check.h"
#include "odometry/wheel/planar_covariance.h"
#include "odometry/wheel/wheel_odometry_params.h"
#include "odometry/wheel/yaw_drift.h"

namespace stereo_nav::odometry {

/// One reading of all counters.
struct WheelSample {
  double time_s = 0.0;
  std::vector<std::int64_t> pulses;  ///< in the order of the drive's wheels; wrap after counter_bits
  std::vector<double> steering_rad;  ///< of each wheel; empty for drives without steered wheels
  std::optional<double> yaw_rad;     ///< of the IMU at this time, counterclockwise; wrapped or not
};

/// What the wheel odometry knows after a sample.
struct WheelOdometryResult {
  double time_s = 0.0;
  Eigen::Isometry2d T_odom_base = Eigen::Isometry2d::Identity();
  Eigen::Matrix3d pose_covariance = Eigen::Matrix3d::Zero();  ///< x, y (m), yaw (rad) in the axes of the base
  kinematics::Twist twist = kinematics::Twist::Zero();        ///< mean over the window, axes of the base
  Eigen::Matrix3d twist_covariance = Eigen::Matrix3d::Zero();  ///< of it
  double slip = 1.0;  ///< root mean square of the normalised contradictions of the last second; 1 is expected
  double yaw_drift_rad_per_s = 0.0;  ///< of the IMU, found while the base rests and taken off
  std::string problem;  ///< an encoder that is reversed, swapped or dead, with the remedy; empty if none
};

/// Pose of a base from the pulses of its wheels. Each interval is an arc: the base moves with a constant
/// twist, found by weighted least squares over all wheels and the IMU's yaw increment, and the pose is
/// composed with its exponential. While the wheels stand still the base does not turn, whatever the IMU says:
/// that shows the drift of its yaw, which is taken off from there on.
class WheelOdometry {
 public:
  /// Throws ParameterError for a drive that cannot be used.
  explicit WheelOdometry(const WheelOdometryParams& params);
  WheelOdometry(const WheelOdometry&) = delete;
  WheelOdometry& operator=(const WheelOdometry&) = delete;

  /// The first sample fixes the zero of the counters and of the yaw. Throws InputError, and changes nothing,
  /// when the numbers of wheels differ or the stamp is not later than the last one.
  WheelOdometryResult process(const WheelSample& sample);

  /// Sets the pose at the last sample; `covariance` in the axes of the base.
  void setPose(const Eigen::Isometry2d& T_odom_base, const Eigen::Matrix3d& covariance);

  /// The interval that the last sample ended; empty before the second sample.
  const WheelStep& lastStep() const { return step_; }
  /// Of one reading of each counter.
  const std::vector<double>& readingVariance_m2() const { return reading_variance_m2_; }

 private:
  struct Mark {
    double time_s;
    Eigen::Isometry2d T_odom_base;
  };

  void check(const WheelSample& sample) const;
  void measureInterval(const WheelSample& sample);
  void takeYaw(const WheelSample& sample);
  void compose(const IntervalMotion& motion);
  WheelOdometryResult resultAt(double time_s);
  Eigen::Matrix3d twistCovariance(double window_s) const;

  WheelOdometryParams params_;
  kinematics::Drive drive_;
  EncoderCheck encoders_;
  PlanarCovariance covariance_;
  YawDrift yaw_drift_;
  std::optional<WheelSample> last_;
  Eigen::Isometry2d T_odom_base_ = Eigen::Isometry2d::Identity();
  WheelStep step_;                           ///< the last interval
  std::vector<double> reading_variance_m2_;  ///< of each counter's reading
  double contradiction_ =
      1.0;  ///< running mean of the square that wheels contradict each other by; 1 is expected
  double slip_factor_ = 1.0;  ///< by which the variance of the slip is raised
  std::deque<Mark> marks_;    ///< poses of the window for the speed
};

}  // namespace stereo_nav::odometry
