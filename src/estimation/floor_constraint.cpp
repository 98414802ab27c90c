#include "stereo_nav/estimation/floor_constraint.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace stereo_nav::estimation {
namespace {

/// A contradiction that one pose in a thousand shows: chi squared of three.
constexpr double kContradiction = 16.3;

/// The turn, as a rotation vector in odom, that makes the base level. It lies in the plane.
Eigen::Vector3d levellingTurn(const Eigen::Matrix3d& R_odom_base) {
  const Eigen::Vector3d up = R_odom_base.col(2);
  return Eigen::AngleAxisd(Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ())).angle() *
         up.cross(Eigen::Vector3d::UnitZ()).normalized();
}

}  // namespace

void FloorParams::describe(ParameterVisitor& visitor) {
  visitor.flag("planar", on, "the robot drives on the plane through the pose at which it starts, or is set",
               Change::kLive);
  visitor.real("planar_height_sigma_m", height_sigma_m, {1e-4, 10.0}, "m",
               "standard deviation of base_link's height above the floor: bumps, tyres", Change::kLive);
  visitor.real("planar_tilt_sigma_rad", tilt_sigma_rad, {1e-4, 1.0}, "rad",
               "standard deviation of its roll and pitch against the floor: suspension, slopes",
               Change::kLive);
}

UncertainPose onFloor(const FloorParams& params, double height_m, const UncertainPose& pose) {
  Eigen::Matrix<double, 3, 6> H = Eigen::Matrix<double, 3, 6>::Zero();  // of height, rotation about x and y
  H(0, 2) = H(1, 3) = H(2, 4) = 1.0;
  Eigen::Vector3d missing;
  missing << height_m - pose.T_odom_base.translation().z(),
      levellingTurn(pose.T_odom_base.linear()).head<2>();
  Eigen::Vector3d variances(params.height_sigma_m, params.tilt_sigma_rad, params.tilt_sigma_rad);
  variances = variances.cwiseAbs2();
  const Eigen::Matrix3d known = H * pose.covariance * H.transpose();
  const auto innovation = [&] { return Eigen::Matrix3d(known + Eigen::Matrix3d(variances.asDiagonal())); };
  variances *= std::max(1.0, missing.dot(innovation().ldlt().solve(missing)) / kContradiction);
  const Eigen::Matrix<double, 6, 3> K = innovation().ldlt().solve(H * pose.covariance).transpose();
  const Vector6d step = K * missing;
  const Matrix6d rest = Matrix6d::Identity() - K * H;
  UncertainPose held;
  held.T_odom_base = pose.T_odom_base;
  held.T_odom_base.translation() += step.head<3>();
  held.T_odom_base.linear() = expRotation(step.tail<3>()) * pose.T_odom_base.linear();
  held.covariance = rest * pose.covariance * rest.transpose() + K * variances.asDiagonal() * K.transpose();
  return held;
}

}  // namespace stereo_nav::estimation
