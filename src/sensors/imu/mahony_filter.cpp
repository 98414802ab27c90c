#include "sensors/imu/mahony_filter.h"

#include <cmath>

#include "stereo_nav/core/lie.h"

namespace stereo_nav::imu {

using Eigen::Vector3d;

/// omega_mes = sum of measured x estimated directions, IMU frame (equation 32c).
Vector3d MahonyFilter::correction(const Directions& measured) const {
  const Vector3d up_estimated = q_world_imu_.conjugate() * Vector3d::UnitZ();
  Vector3d omega_mes = Vector3d::Zero();
  if (measured.up) omega_mes += measured.up->cross(up_estimated);
  if (measured.field) {
    const Vector3d field_world = q_world_imu_ * *measured.field;
    const Vector3d reference(0.0, std::hypot(field_world.x(), field_world.y()), field_world.z());
    const Vector3d turn = measured.field->cross(q_world_imu_.conjugate() * reference);
    omega_mes += up_estimated * up_estimated.dot(turn);
  }
  return omega_mes;
}

void MahonyFilter::step(const Vector3d& angular_velocity, const Directions& measured, double dt_s) {
  const Vector3d omega_mes = correction(measured);
  gyro_bias_ -= params_.mahony_ki * dt_s * omega_mes;
  const Vector3d rotation = (angular_velocity - gyro_bias_ + params_.mahony_kp * omega_mes) * dt_s;
  q_world_imu_ = q_world_imu_ * expQuaternion(rotation);
}

}  // namespace stereo_nav::imu
