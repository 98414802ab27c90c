#include "stereo_nav/core/lie.h"

#include <cmath>

namespace stereo_nav {
namespace {

constexpr double kSmallAngle_rad = 1e-6;

}  // namespace

Eigen::Matrix3d hat(const Eigen::Vector3d& v) {
  Eigen::Matrix3d cross;
  cross << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return cross;
}

Eigen::Quaterniond expQuaternion(const Eigen::Vector3d& angle) {
  const double norm = angle.norm();
  if (norm < kSmallAngle_rad)
    return Eigen::Quaterniond(1.0, 0.5 * angle.x(), 0.5 * angle.y(), 0.5 * angle.z()).normalized();
  return Eigen::Quaterniond(Eigen::AngleAxisd(norm, angle / norm));
}

Eigen::Matrix3d expRotation(const Eigen::Vector3d& angle) {
  const double norm = angle.norm();
  if (norm < kSmallAngle_rad) return expQuaternion(angle).toRotationMatrix();
  return Eigen::AngleAxisd(norm, angle / norm).toRotationMatrix();
}

Eigen::Vector3d logRotation(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const double sine = q.vec().norm();
  if (sine < kSmallAngle_rad) return 2.0 * sign * q.vec();
  return 2.0 * std::atan2(sine, sign * q.w()) / sine * sign * q.vec();
}

Eigen::Vector3d logRotation(const Eigen::Matrix3d& R) {
  return logRotation(Eigen::Quaterniond(R));
}

Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& angle) {
  const double norm = angle.norm();
  const Eigen::Matrix3d cross = hat(angle);
  if (norm < kSmallAngle_rad) return Eigen::Matrix3d::Identity() + 0.5 * cross;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(norm)) / (norm * norm) * cross +
         (norm - std::sin(norm)) / (norm * norm * norm) * cross * cross;
}

Eigen::Isometry3d expMotion(const Vector6d& twist) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = expRotation(twist.tail<3>());
  T.translation() = leftJacobian(twist.tail<3>()) * twist.head<3>();
  return T;
}

Vector6d logMotion(const Eigen::Isometry3d& T) {
  Vector6d twist;
  const Eigen::Matrix3d R = T.linear();
  twist.tail<3>() = logRotation(R);
  twist.head<3>() = leftJacobian(twist.tail<3>()).inverse() * T.translation();
  return twist;
}

Matrix6d adjoint(const Eigen::Isometry3d& T_a_b) {
  const Eigen::Matrix3d R = T_a_b.linear();
  Matrix6d result = Matrix6d::Zero();
  result.topLeftCorner<3, 3>() = R;
  result.topRightCorner<3, 3>() = hat(T_a_b.translation()) * R;
  result.bottomRightCorner<3, 3>() = R;
  return result;
}

Matrix6d turned(const Eigen::Matrix3d& R_a_b, const Matrix6d& covariance) {
  Matrix6d both = Matrix6d::Zero();
  both.topLeftCorner<3, 3>() = R_a_b;
  both.bottomRightCorner<3, 3>() = R_a_b;
  return both * covariance * both.transpose();
}

Matrix6d inverseLeftJacobian(const Vector6d& twist) {
  Matrix6d ad = Matrix6d::Zero();  // the adjoint of the twist itself
  ad.topLeftCorner<3, 3>() = hat(twist.tail<3>());
  ad.topRightCorner<3, 3>() = hat(twist.head<3>());
  ad.bottomRightCorner<3, 3>() = hat(twist.tail<3>());
  return Matrix6d::Identity() - 0.5 * ad + ad * ad / 12.0;
}

Eigen::Isometry3d renormalised(const Eigen::Isometry3d& T) {
  Eigen::Isometry3d result = T;
  result.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return result;
}

}  // namespace stereo_nav
