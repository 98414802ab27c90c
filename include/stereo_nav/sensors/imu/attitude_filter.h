#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::imu {

/// Calibrated measurements of one instant, IMU frame (front-left-up).
struct InertialSample {
  double time_s = 0.0;  ///< of the measurement, seconds since any fixed moment
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();     ///< rad/s
  Eigen::Vector3d linear_acceleration = Eigen::Vector3d::Zero();  ///< specific force, m/s^2
  std::optional<Eigen::Vector3d> magnetic_field;                  ///< any unit
};

/// How the orientation is computed from the readings of a raw module.
enum class AttitudeMethod { kMahony, kMadgwick };

/// The gains are low, for a robot that drives: every curve and every braking tilts what the accelerometer
/// measures, while the gyroscope is calibrated.
struct AttitudeParams {
  AttitudeMethod method = AttitudeMethod::kMahony;  ///< which filter is made by makeAttitudeFilter()
  bool use_magnetometer = false;                    ///< whether the heading comes from the magnetic field
  double acceleration_gate_m_s2 = 1.0;  ///< largest difference from gravity at which the accelerometer counts
  double mahony_kp = 0.15;              ///< correction of the attitude, 1/s
  double mahony_ki = 0.005;             ///< correction of the bias, 1/s^2
  double madgwick_beta = 0.005;         ///< correction of the attitude, rad/s
  double madgwick_zeta = 0.0002;        ///< correction of the bias, rad/s^2

  /// Names, ranges and meanings of the parameters.
  void describe(ParameterVisitor& visitor);
};

/// Attitude from gyroscope, accelerometer and, when wanted, magnetometer.
///
/// `q_world_imu` takes IMU coordinates into a world with z up. Its x axis points east when a magnetometer is
/// used (REP-103; declination is not corrected), otherwise along the IMU's x axis at the start. Without a
/// magnetometer the yaw drifts by the gyroscope's remaining bias; a filter cannot prevent that.
///
/// The accelerometer measures gravity only while the robot does not accelerate: samples whose magnitude
/// differs from 9.80665 by more than `acceleration_gate_m_s2` are integrated from the gyroscope alone.
class AttitudeFilter {
 public:
  /// Standard gravity.
  static constexpr double kGravity_m_s2 = 9.80665;
  /// Nothing is integrated over a longer gap: the tilt is taken from the accelerometer again, the heading is
  /// kept.
  static constexpr double kMaxGap_s = 0.2;

  /// The filter starts with the first usable sample.
  explicit AttitudeFilter(const AttitudeParams& params) : params_(params) {}
  virtual ~AttitudeFilter() = default;

  /// The times of the samples must increase; a sample that does not is ignored, and false is returned.
  bool update(const InertialSample& sample);
  /// Forgets attitude and bias; the next usable sample is a new start.
  void reset();

  /// The bias is taken to be zero from now on.
  void forgetBias() { gyro_bias_.setZero(); }

  /// False until a first sample with a usable accelerometer (and magnetometer, where used) has come.
  bool initialised() const { return initialised_; }
  /// Takes IMU coordinates into the world frame.
  const Eigen::Quaterniond& q_world_imu() const { return q_world_imu_; }
  /// The bias the filter has found and subtracts, rad/s.
  const Eigen::Vector3d& gyroBias() const { return gyro_bias_; }

 protected:
  /// The directions of up and of the magnetic field that a sample gives.
  struct Directions {
    std::optional<Eigen::Vector3d> up;     ///< measured, unit, IMU frame
    std::optional<Eigen::Vector3d> field;  ///< measured, unit, IMU frame
  };
  /// Advances `q_world_imu_` by `dt_s`. The result need not be normalised. The function may change
  /// `gyro_bias_`.
  virtual void step(const Eigen::Vector3d& angular_velocity, const Directions& measured, double dt_s) = 0;

  /// The parameters given to the constructor.
  AttitudeParams params_;
  /// The attitude that step() advances.
  Eigen::Quaterniond q_world_imu_ = Eigen::Quaterniond::Identity();
  /// The bias that step() subtracts, rad/s.
  Eigen::Vector3d gyro_bias_ = Eigen::Vector3d::Zero();

 private:
  Directions directionsOf(const InertialSample& sample) const;
  bool initialise(const Directions& measured, bool keep_heading);

  bool initialised_ = false;
  double last_time_s_ = 0.0;
};

/// The filter that `params.method` names.
std::unique_ptr<AttitudeFilter> makeAttitudeFilter(const AttitudeParams& params);

}  // namespace stereo_nav::imu
