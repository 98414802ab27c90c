#include "estimation/ekf/odometry_motion.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace stereo_nav::estimation {
namespace {

constexpr double kLeastSigma_m = 1e-4;
constexpr double kLeastSigma_rad = 1e-5;
constexpr double kUselessVariance = 1e5;
constexpr double kUntold_s = 60.0;  ///< as long an unseen speed is wrong alike: 30 m of a corridor at 0.5 m/s

/// The nearest covariance whose variances are not below what an odometry can reach.
Matrix6d withoutNegativeParts(const Matrix6d& difference) {
  Vector6d least;
  least << Eigen::Vector3d::Constant(kLeastSigma_m), Eigen::Vector3d::Constant(kLeastSigma_rad);
  const Matrix6d scaled = least.cwiseInverse().asDiagonal() * difference * least.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(0.5 * (scaled + scaled.transpose()));
  const Matrix6d clipped = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(1.0).asDiagonal() *
                           eigen.eigenvectors().transpose();
  return least.asDiagonal() * clipped * least.asDiagonal();
}

bool grows(const ChannelMemory& memory, const Measurement& measurement) {
  for (const int field : measurement.fields) {
    if (measurement.covariance(field, field) == memory.odometry_covariance(field, field)) return false;
  }
  return true;
}

/// Fields that are unknown would drown those that are known in rounding.
Matrix6d withoutUnknown(const Matrix6d& covariance, const std::vector<int>& fields) {
  Matrix6d known = Matrix6d::Zero();
  for (const int i : fields) {
    for (const int j : fields) known(i, j) = covariance(i, j);
  }
  return known;
}

bool usable(const Matrix6d& covariance, const std::vector<int>& fields) {
  for (const int field : fields) {
    const double variance = covariance(field, field);
    if (!(variance > 0.0 && variance < kUselessVariance)) return false;
  }
  return covariance.allFinite();
}

/// Along the directions in which the speed is not told, the errors of successive motions are no noise but one
/// and the same: as independent ones they need a variance that is larger by the time that they last over that
/// of a motion. `told` is the covariance of the motion by the odometry's speed.
void loosenUntold(const Matrix6d& told, OdometryMotion& motion) {
  if (motion.duration_s <= 0.0 || motion.duration_s >= kUntold_s) return;
  const double limit = std::pow(kToldSigma_m_s * motion.duration_s, 2);
  if (told.diagonal().head<3>().maxCoeff() <= limit) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(told.topLeftCorner<3, 3>());
  Eigen::Vector3d added = eigen.eigenvalues() * (kUntold_s / motion.duration_s);
  for (int i = 0; i < 3; ++i) {
    if (eigen.eigenvalues()[i] <= limit) added[i] = 0.0;
  }
  motion.covariance.topLeftCorner<3, 3>() +=
      eigen.eigenvectors() * added.asDiagonal() * eigen.eigenvectors().transpose();
}

Matrix6d assumed(const Eigen::Isometry3d& motion) {
  const double way_m = 0.002 + 0.05 * motion.translation().norm();
  const double turn_rad = 0.001 + 0.05 * logRotation(Eigen::Matrix3d(motion.linear())).norm();
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(way_m * way_m), Eigen::Vector3d::Constant(turn_rad * turn_rad);
  return variances.asDiagonal();
}

}  // namespace

OdometryMotion motionSince(const ChannelMemory& memory, const Measurement& measurement) {
  OdometryMotion result;
  result.motion = memory.T_odometry_base.inverse() * measurement.pose;
  result.duration_s = measurement.time_s - memory.anchored_s;
  const bool twist_known =
      measurement.twist_covariance && usable(*measurement.twist_covariance, measurement.fields);
  Matrix6d by_twist = Matrix6d::Zero();
  if (twist_known) {
    by_twist = withoutUnknown(*measurement.twist_covariance, measurement.fields) *
               (result.duration_s * result.duration_s);
  }
  if (grows(memory, measurement)) {
    const Matrix6d carry = adjoint(result.motion.inverse());
    const Matrix6d now = turned(measurement.pose.linear().transpose(),
                                withoutUnknown(measurement.covariance, measurement.fields));
    const Matrix6d then = turned(memory.T_odometry_base.linear().transpose(),
                                 withoutUnknown(memory.odometry_covariance, measurement.fields));
    result.covariance = withoutNegativeParts(now - carry * then * carry.transpose());
  } else {
    result.covariance = twist_known ? by_twist : assumed(result.motion);
  }
  loosenUntold(by_twist, result);
  return result;
}

}  // namespace stereo_nav::estimation
