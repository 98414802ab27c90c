#include "stereo_nav/core/lie.h"

#include <cmath>

namespace stereo_nav {
namespace {

constexpr double kSmallAngle_rad = 1e-6;

/// V with translation of exp(twist) = V * twist.head<3>().
Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& angle) {
  const double norm = angle.norm();
  const Eigen::Matrix3d cross = skew(angle);
  if (norm < kSmallAngle_rad) return Eigen::Matrix3d::Identity() + 0.5 * cross;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(norm)) / (norm * norm) * cross +
         (norm - std::sin(norm)) / (norm * norm * norm) * cross * cross;
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d cross;
  cross << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return cross;
}

Eigen::Matrix3d expRotation(const Eigen::Vector3d& angle) {
  const double norm = angle.norm();
  if (norm < kSmallAngle_rad)
    return Eigen::Quaterniond(1.0, 0.5 * angle.x(), 0.5 * angle.y(), 0.5 * angle.z())
        .normalized()
        .toRotationMatrix();
  return Eigen::AngleAxisd(norm, angle / norm).toRotationMatrix();
}

Eigen::Vector3d logRotation(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const double sine = q.vec().norm();
  if (sine < kSmallAngle_rad) return 2.0 * sign * q.vec();
  return 2.0 * std::atan2(sine, sign * q.w()) / sine * sign * q.vec();
}

Eigen::Isometry3d expMotion(const Vector6d& twist) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = expRotation(twist.tail<3>());
  T.translation() = leftJacobian(twist.tail<3>()) * twist.head<3>();
  return T;
}

Vector6d logMotion(const Eigen::Isometry3d& T) {
  Vector6d twist;
  twist.tail<3>() = logRotation(T.linear());
  twist.head<3>() = leftJacobian(twist.tail<3>()).inverse() * T.translation();
  return twist;
}

Matrix6d inverseLeftJacobian(const Vector6d& twist) {
  Matrix6d adjoint = Matrix6d::Zero();
  adjoint.topLeftCorner<3, 3>() = skew(twist.tail<3>());
  adjoint.topRightCorner<3, 3>() = skew(twist.head<3>());
  adjoint.bottomRightCorner<3, 3>() = skew(twist.tail<3>());
  return Matrix6d::Identity() - 0.5 * adjoint + adjoint * adjoint / 12.0;
}

Eigen::Isometry3d renormalised(const Eigen::Isometry3d& T) {
  Eigen::Isometry3d result = T;
  result.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return result;
}

}  // namespace stereo_nav
