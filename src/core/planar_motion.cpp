#include "core/planar_motion.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace stereo_nav {
namespace {

/// sin(a) / a and (1 - cos(a)) / a, with their series near zero.
struct Arc {
  double along;
  double across;
};

constexpr Eigen::Index kPlanarAxes[] = {0, 1, 5};  // x, y and yaw among those of a pose in space
constexpr double kSeriesAngle_rad = 1e-4;

Arc arcOf(double angle_rad) {
  if (std::abs(angle_rad) < kSeriesAngle_rad) return {1.0 - angle_rad * angle_rad / 6.0, 0.5 * angle_rad};
  return {std::sin(angle_rad) / angle_rad, (1.0 - std::cos(angle_rad)) / angle_rad};
}

}  // namespace

Eigen::Isometry2d expPlanar(const Eigen::Vector3d& twist) {
  const Arc arc = arcOf(twist.z());
  Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
  T.linear() = Eigen::Rotation2Dd(twist.z()).toRotationMatrix();
  T.translation() << arc.along * twist.x() - arc.across * twist.y(),
      arc.across * twist.x() + arc.along * twist.y();
  return T;
}

double yawOf(const Eigen::Isometry2d& T) {
  return std::atan2(T(1, 0), T(0, 0));
}

Eigen::Vector3d logPlanar(const Eigen::Isometry2d& T) {
  const double angle_rad = yawOf(T);
  const Arc arc = arcOf(angle_rad);
  const double scale = 1.0 / (arc.along * arc.along + arc.across * arc.across);
  const Eigen::Vector2d t = T.translation();
  return {scale * (arc.along * t.x() + arc.across * t.y()), scale * (arc.along * t.y() - arc.across * t.x()),
          angle_rad};
}

Eigen::Isometry2d planarPart(const Eigen::Isometry3d& T) {
  Eigen::Isometry2d planar = Eigen::Isometry2d::Identity();
  planar.linear() = Eigen::Rotation2Dd(std::atan2(T(1, 0), T(0, 0))).toRotationMatrix();
  planar.translation() = T.translation().head<2>();
  return planar;
}

Eigen::Isometry3d inSpace(const Eigen::Isometry2d& T) {
  Eigen::Isometry3d spatial = Eigen::Isometry3d::Identity();
  spatial.linear().topLeftCorner<2, 2>() = T.linear();
  spatial.translation().head<2>() = T.translation();
  return spatial;
}

Eigen::Matrix3d adjointPlanar(const Eigen::Isometry2d& T_a_b) {
  Eigen::Matrix3d result = Eigen::Matrix3d::Identity();
  result.topLeftCorner<2, 2>() = T_a_b.linear();
  result(0, 2) = T_a_b.translation().y();
  result(1, 2) = -T_a_b.translation().x();
  return result;
}

Eigen::Matrix3d inAxesOf(const Eigen::Isometry2d& T_odom_base, const Eigen::Matrix3d& covariance) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = T_odom_base.linear();
  return R * covariance * R.transpose();
}

double largestSigma(const Eigen::Matrix2d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().y()));
}

Matrix6d spatialCovariance(const Eigen::Matrix3d& planar) {
  constexpr double kUnknown = 1e6;
  Matrix6d spatial = kUnknown * Matrix6d::Identity();
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j) spatial(kPlanarAxes[i], kPlanarAxes[j]) = planar(i, j);
  return spatial;
}

Eigen::Matrix3d planarCovariance(const Matrix6d& spatial) {
  Eigen::Matrix3d planar;
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j) planar(i, j) = spatial(kPlanarAxes[i], kPlanarAxes[j]);
  return planar;
}

Eigen::Matrix3d leftJacobianPlanar(const Eigen::Vector3d& twist) {
  const double a = twist.z();
  const Arc arc = arcOf(a);
  // (a - sin(a)) / a^2 and (1 - cos(a)) / a^2.
  const bool small = std::abs(a) < kSeriesAngle_rad;
  const double sine_rest = small ? a / 6.0 : (a - std::sin(a)) / (a * a);
  const double cosine_rest = small ? 0.5 : (1.0 - std::cos(a)) / (a * a);
  Eigen::Matrix3d result;
  result << arc.along, -arc.across, sine_rest * twist.x() + cosine_rest * twist.y(),  //
      arc.across, arc.along, sine_rest * twist.y() - cosine_rest * twist.x(),         //
      0.0, 0.0, 1.0;
  return result;
}

}  // namespace stereo_nav
