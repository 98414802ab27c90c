#include "sensors/imu/madgwick_filter.h"

#include <cmath>

namespace stereo_nav::imu {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Jacobian = Eigen::Matrix<double, 3, 4>;

/// The world's y and z axes in IMU coordinates (second and third row of R_world_imu), which for unit
/// quaternions may be written with 1 - 2(...): the form of Madgwick's equations (25) and (29).
Vector3d yAxis(const Vector4d& q) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  return {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)};
}

Vector3d zAxis(const Vector4d& q) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  return {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)};
}

Jacobian yAxisJacobian(const Vector4d& q) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  Jacobian J;
  J << 2 * z, 2 * y, 2 * x, 2 * w, 0, -4 * x, 0, -4 * z, -2 * x, -2 * w, 2 * z, 2 * y;
  return J;
}

Jacobian zAxisJacobian(const Vector4d& q) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  Jacobian J;
  J << -2 * y, 2 * z, -2 * w, 2 * x, 2 * x, 2 * w, 2 * z, 2 * y, 0, -4 * x, -4 * y, 0;
  return J;
}

Vector4d coefficients(const Quaterniond& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace

double MadgwickFilter::objective(const Vector4d& wxyz, const Vector3d* up, const Vector3d* field,
                                 const Vector3d& field_reference) {
  double sum = 0.0;
  if (up != nullptr) sum += (zAxis(wxyz) - *up).squaredNorm();
  if (field != nullptr) {
    sum += (field_reference.y() * yAxis(wxyz) + field_reference.z() * zAxis(wxyz) - *field).squaredNorm();
  }
  return sum;
}

/// Twice J^T f, equation (20) with the functions (25) and (29).
Vector4d MadgwickFilter::gradient(const Vector4d& wxyz, const Vector3d* up, const Vector3d* field,
                                  const Vector3d& field_reference) {
  Vector4d sum = Vector4d::Zero();
  if (up != nullptr) sum += 2.0 * zAxisJacobian(wxyz).transpose() * (zAxis(wxyz) - *up);
  if (field != nullptr) {
    const Vector3d difference =
        field_reference.y() * yAxis(wxyz) + field_reference.z() * zAxis(wxyz) - *field;
    sum +=
        2.0 *
        (field_reference.y() * yAxisJacobian(wxyz) + field_reference.z() * zAxisJacobian(wxyz)).transpose() *
        difference;
  }
  return sum;
}

void MadgwickFilter::step(const Vector3d& angular_velocity, const Directions& measured, double dt_s) {
  // The field's reference keeps the measured inclination (equations 45, 46).
  Vector3d reference = Vector3d::Zero();
  if (measured.field) {
    const Vector3d field_world = q_world_imu_ * *measured.field;
    reference << 0.0, std::hypot(field_world.x(), field_world.y()), field_world.z();
  }
  const Vector4d q = coefficients(q_world_imu_);
  Vector4d direction = gradient(q, measured.up ? &*measured.up : nullptr,
                                measured.field ? &*measured.field : nullptr, reference);
  const double length = direction.norm();
  direction = length > 1e-12 ? Vector4d(direction / length) : Vector4d(Vector4d::Zero());

  // Bias: the error's direction as an angular rate (equations 47 to 49).
  const Quaterniond direction_q(direction[0], direction[1], direction[2], direction[3]);
  gyro_bias_ += params_.madgwick_zeta * dt_s * 2.0 * (q_world_imu_.conjugate() * direction_q).vec();
  const Vector3d rate = angular_velocity - gyro_bias_;
  const Quaterniond rate_q(0.0, rate.x(), rate.y(), rate.z());
  const Vector4d q_dot = 0.5 * coefficients(q_world_imu_ * rate_q) - params_.madgwick_beta * direction;
  const Vector4d next = q + q_dot * dt_s;  // equations (42), (44)
  q_world_imu_ = Quaterniond(next[0], next[1], next[2], next[3]);
}

}  // namespace stereo_nav::imu
