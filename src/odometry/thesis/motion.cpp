#include "odometry/thesis/motion.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::odometry {
namespace {

constexpr double kNearestDepth_m = 1e-3;

/// Rotation and translation have 6 unknowns; with 3 residuals a pair, two pairs would leave nothing to judge
/// by.
constexpr std::size_t kFewestPairs = 3;

struct NormalEquations {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
};

NormalEquations linearise(const RefinementParams& params, const vision::StereoCalibration& calibration,
                          const std::vector<PointPair>& pairs, const std::vector<bool>& used,
                          const Eigen::Isometry3d& T_cur_prev) {
  NormalEquations equations;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!used[i] || (T_cur_prev * pairs[i].p_previous).z() < kNearestDepth_m) continue;
    Eigen::Matrix<double, 3, 6> jacobian;
    const Eigen::Vector3d residual = reprojectionResidual(calibration, pairs[i], T_cur_prev, &jacobian);
    const double error_px = residual.norm();
    const double weight = error_px <= params.huber_px ? 1.0 : params.huber_px / error_px;
    equations.information.noalias() += weight * jacobian.transpose() * jacobian;
    equations.gradient.noalias() += weight * jacobian.transpose() * residual;
  }
  return equations;
}

void selectInliers(const RefinementParams& params, const vision::StereoCalibration& calibration,
                   const std::vector<PointPair>& pairs, RefinedMotion& motion) {
  double squares = 0.0;
  motion.inliers = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    motion.inlier[i] = false;
    if ((motion.T_cur_prev * pairs[i].p_previous).z() < kNearestDepth_m) continue;
    const double squared_px =
        reprojectionResidual(calibration, pairs[i], motion.T_cur_prev, nullptr).squaredNorm();
    if (squared_px > params.max_error_px * params.max_error_px) continue;
    motion.inlier[i] = true;
    squares += squared_px;
    ++motion.inliers;
  }
  motion.rms_px = motion.inliers == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(3 * motion.inliers));
}

bool descend(const RefinementParams& params, const vision::StereoCalibration& calibration,
             const std::vector<PointPair>& pairs, const std::vector<bool>& used, RefinedMotion& motion) {
  constexpr double kSmallStep = 1e-8;
  for (int i = 0; i < params.iterations; ++i) {
    const NormalEquations equations = linearise(params, calibration, pairs, used, motion.T_cur_prev);
    const Eigen::LDLT<Matrix6d> solver(equations.information);
    if (solver.info() != Eigen::Success || !solver.isPositive()) return false;
    const Vector6d step = solver.solve(-equations.gradient);
    if (!step.allFinite()) return false;
    motion.T_cur_prev = perturb(motion.T_cur_prev, step);
    if (step.norm() < kSmallStep) break;
  }
  return true;
}

}  // namespace

void RefinementParams::describe(ParameterVisitor& visitor) {
  visitor.integer("iterations", iterations, {1, 100}, "",
                  "most Gauss-Newton iterations of each of the two passes");
  visitor.real("huber_px", huber_px, {0.01, 100.0}, "px", "larger reprojection errors count linearly");
  visitor.real("max_error_px", max_error_px, {0.01, 100.0}, "px", "reprojection error of an inlier at most");
}

Eigen::Vector3d meanTranslation(const Eigen::Matrix3d& R_cur_prev, const std::vector<PointPair>& pairs) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const PointPair& pair : pairs) sum += R_cur_prev * pair.p_previous - pair.p_current;
  return sum / static_cast<double>(pairs.size());
}

Eigen::Isometry3d alignPoints(const std::vector<PointPair>& pairs) {
  Eigen::Matrix3Xd previous(3, static_cast<Eigen::Index>(pairs.size()));
  Eigen::Matrix3Xd current(3, static_cast<Eigen::Index>(pairs.size()));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    previous.col(static_cast<Eigen::Index>(i)) = pairs[i].p_previous;
    current.col(static_cast<Eigen::Index>(i)) = pairs[i].p_current;
  }
  return Eigen::Isometry3d(Eigen::umeyama(previous, current, false));
}

Eigen::Vector3d reprojectionResidual(const vision::StereoCalibration& calibration, const PointPair& pair,
                                     const Eigen::Isometry3d& T_cur_prev,
                                     Eigen::Matrix<double, 3, 6>* jacobian) {
  const Eigen::Vector3d p = T_cur_prev * pair.p_previous;
  if (jacobian != nullptr) {
    const double inverse_z = 1.0 / p.z();
    Eigen::Matrix3d by_point;
    by_point << calibration.fx * inverse_z, 0.0, -calibration.fx * p.x() * inverse_z * inverse_z,  //
        0.0, calibration.fy * inverse_z, -calibration.fy * p.y() * inverse_z * inverse_z,          //
        calibration.fx * inverse_z, 0.0,
        -calibration.fx * (p.x() - calibration.baseline_m) * inverse_z * inverse_z;
    Eigen::Matrix3d minus_cross;
    minus_cross << 0.0, p.z(), -p.y(), -p.z(), 0.0, p.x(), p.y(), -p.x(), 0.0;
    jacobian->leftCols<3>() = by_point;
    jacobian->rightCols<3>() = by_point * minus_cross;
  }
  return calibration.project(p) - calibration.project(pair.p_current);
}

Eigen::Isometry3d perturb(const Eigen::Isometry3d& T, const Vector6d& delta) {
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d rotation = delta.tail<3>();
  const double angle = rotation.norm();
  if (angle > 0.0) step.linear() = Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
  step.translation() = delta.head<3>();
  return step * T;
}

RefinedMotion refineMotion(const RefinementParams& params, const vision::StereoCalibration& calibration,
                           const std::vector<PointPair>& pairs, const Eigen::Isometry3d& T_cur_prev) {
  RefinedMotion motion;
  motion.T_cur_prev = T_cur_prev;
  motion.covariance.setZero();
  motion.inlier.assign(pairs.size(), true);
  if (!descend(params, calibration, pairs, motion.inlier, motion)) return motion;
  selectInliers(params, calibration, pairs, motion);
  if (motion.inliers < kFewestPairs || !descend(params, calibration, pairs, motion.inlier, motion))
    return motion;
  selectInliers(params, calibration, pairs, motion);
  if (motion.inliers < kFewestPairs) return motion;

  const auto freedom = static_cast<double>(3 * motion.inliers - 6);
  const double variance_px2 =
      motion.rms_px * motion.rms_px * static_cast<double>(3 * motion.inliers) / freedom;
  const Matrix6d information =
      linearise(params, calibration, pairs, motion.inlier, motion.T_cur_prev).information;
  const Eigen::LDLT<Matrix6d> solver(information);
  motion.covariance = variance_px2 * solver.solve(Matrix6d::Identity());
  motion.converged = solver.isPositive() && motion.covariance.allFinite();
  // The rotation must stay one over thousands of products.
  motion.T_cur_prev.linear() = Eigen::Quaterniond(motion.T_cur_prev.linear()).normalized().toRotationMatrix();
  return motion;
}

}  // namespace stereo_nav::odometry
