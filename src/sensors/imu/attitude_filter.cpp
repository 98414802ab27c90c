#include "stereo_nav/sensors/imu/attitude_filter.h"

#include <cmath>

#include "sensors/imu/madgwick_filter.h"
#include "sensors/imu/mahony_filter.h"
#include "sensors/imu/module_angles.h"

namespace stereo_nav::imu {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The attitude whose rotation matrix R_world_imu has the world's axes, seen from the IMU, as rows.
Eigen::Quaterniond fromRows(const Vector3d& x_axis, const Vector3d& y_axis, const Vector3d& z_axis) {
  Matrix3d R_world_imu;
  R_world_imu << x_axis.transpose(), y_axis.transpose(), z_axis.transpose();
  return Eigen::Quaterniond(R_world_imu);
}

Eigen::Quaterniond levelledByMagnet(const Vector3d& up, const Vector3d& field) {
  const Vector3d east = field.cross(up).normalized();
  return fromRows(east, up.cross(east), up);
}

/// The heading is zero; it is arbitrary when the x axis points straight up or down.
Eigen::Quaterniond levelled(const Vector3d& up) {
  const Vector3d left = up.cross(Vector3d::UnitX());
  if (left.norm() < 1e-3) return Eigen::Quaterniond::FromTwoVectors(up, Vector3d::UnitZ());
  return fromRows(left.normalized().cross(up), left.normalized(), up);
}

}  // namespace

void AttitudeParams::describe(ParameterVisitor& visitor) {
  visitEnum(visitor, "method", method,
            {{"mahony", AttitudeMethod::kMahony}, {"madgwick", AttitudeMethod::kMadgwick}},
            "filter that computes the orientation from raw measurements");
  visitor.flag(
      "use_magnetometer", use_magnetometer,
      "take the heading from the magnetometer, which must be calibrated and away from iron and motors");
  visitor.real("acceleration_gate_m_s2", acceleration_gate_m_s2, {0.05, 100.0}, "m/s^2",
               "accelerations whose magnitude differs from gravity by more are not used");
  visitor.real("mahony_kp", mahony_kp, {0.0, 50.0}, "1/s", "Mahony: correction of the attitude");
  visitor.real("mahony_ki", mahony_ki, {0.0, 10.0}, "1/s^2", "Mahony: correction of the gyroscope bias");
  visitor.real("madgwick_beta", madgwick_beta, {0.0, 5.0}, "rad/s", "Madgwick: correction of the attitude");
  visitor.real("madgwick_zeta", madgwick_zeta, {0.0, 1.0}, "rad/s^2",
               "Madgwick: correction of the gyroscope bias");
}

void AttitudeFilter::reset() {
  q_world_imu_.setIdentity();
  gyro_bias_.setZero();
  initialised_ = false;
}

bool AttitudeFilter::update(const InertialSample& sample) {
  const Directions measured = directionsOf(sample);
  if (!initialised_) {
    initialised_ = initialise(measured, false);
    last_time_s_ = sample.time_s;
    return initialised_;
  }
  const double dt_s = sample.time_s - last_time_s_;
  if (dt_s <= 0.0) return false;
  last_time_s_ = sample.time_s;
  if (dt_s > kMaxGap_s) {
    initialise(measured, true);
    return true;
  }
  step(sample.angular_velocity, measured, dt_s);
  q_world_imu_.normalize();
  return true;
}

AttitudeFilter::Directions AttitudeFilter::directionsOf(const InertialSample& sample) const {
  Directions measured;
  const double magnitude = sample.linear_acceleration.norm();
  if (std::abs(magnitude - kGravity_m_s2) <= params_.acceleration_gate_m_s2) {
    measured.up = sample.linear_acceleration / magnitude;
  }
  if (params_.use_magnetometer && sample.magnetic_field && sample.magnetic_field->norm() > 1e-9) {
    measured.field = sample.magnetic_field->normalized();
  }
  return measured;
}

bool AttitudeFilter::initialise(const Directions& measured, bool keep_heading) {
  if (!measured.up || (params_.use_magnetometer && !measured.field)) return false;
  if (measured.field && measured.field->cross(*measured.up).norm() > 1e-3) {
    q_world_imu_ = levelledByMagnet(*measured.up, *measured.field);
    return true;
  }
  const double kept_heading = keep_heading ? heading(q_world_imu_) : 0.0;
  q_world_imu_ = levelled(*measured.up);
  const double turn = keep_heading ? kept_heading - heading(q_world_imu_) : 0.0;
  q_world_imu_ = Eigen::AngleAxisd(turn, Vector3d::UnitZ()) * q_world_imu_;
  return true;
}

std::unique_ptr<AttitudeFilter> makeAttitudeFilter(const AttitudeParams& params) {
  if (params.method == AttitudeMethod::kMadgwick) return std::make_unique<MadgwickFilter>(params);
  return std::make_unique<MahonyFilter>(params);
}

}  // namespace stereo_nav::imu
