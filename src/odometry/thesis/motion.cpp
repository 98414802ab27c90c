#include "odometry/thesis/motion.h"

#include <algorithm>
#include <cmath>

#include "core/gauss_newton.h"
#include "vision/reprojection.h"

namespace stereo_nav::odometry {
namespace {

/// Rotation and translation are 6 unknowns and a pair gives 3 residuals: two pairs would leave nothing to
/// judge the motion by.
constexpr std::size_t kFewestPairs = 3;

struct NormalEquations {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
};

NormalEquations linearise(const RefinementParams& params, const vision::StereoCalibration& calibration,
                          const std::vector<PointPair>& pairs, const std::vector<bool>& used,
                          const Eigen::Isometry3d& T_current_previous) {
  NormalEquations equations;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!used[i] || !isProjectable(pairs[i], T_current_previous)) continue;
    Eigen::Matrix<double, 3, 6> jacobian;
    const Eigen::Vector3d residual =
        reprojectionResidual(calibration, pairs[i], T_current_previous, &jacobian);
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
    if (!isProjectable(pairs[i], motion.T_current_previous)) continue;
    const double squared_px =
        reprojectionResidual(calibration, pairs[i], motion.T_current_previous, nullptr).squaredNorm();
    if (squared_px > params.max_error_px * params.max_error_px) continue;
    motion.inlier[i] = true;
    squares += squared_px;
    ++motion.inliers;
  }
  motion.rms_px = motion.inliers == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(3 * motion.inliers));
}

/// The rotation and the translation of a step apart: to first order expMotion(delta), and no further from it
/// than a step that ends the descent. It keeps the thesis' odometry at the figures of earlier versions.
Eigen::Isometry3d stepMotion(const Vector6d& delta) {
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  step.linear() = expRotation(delta.tail<3>());
  step.translation() = delta.head<3>();
  return step;
}

bool descend(const RefinementParams& params, const vision::StereoCalibration& calibration,
             const std::vector<PointPair>& pairs, const std::vector<bool>& used, RefinedMotion& motion) {
  constexpr double kSmallStep = 1e-8;
  for (int i = 0; i < params.iterations; ++i) {
    const NormalEquations equations = linearise(params, calibration, pairs, used, motion.T_current_previous);
    const auto step = gaussNewtonStep(equations.information, equations.gradient);
    if (!step) return false;
    motion.T_current_previous = stepMotion(*step) * motion.T_current_previous;
    if (step->norm() < kSmallStep) break;
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

Eigen::Vector3d meanTranslation(const Eigen::Matrix3d& R_current_previous,
                                const std::vector<PointPair>& pairs) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const PointPair& pair : pairs) sum += R_current_previous * pair.p_previous - pair.p_current;
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
                                     const Eigen::Isometry3d& T_current_previous,
                                     Eigen::Matrix<double, 3, 6>* jacobian) {
  const Eigen::Vector3d p = T_current_previous * pair.p_previous;
  if (jacobian != nullptr) {
    Eigen::Matrix3d by_point;
    by_point << vision::leftProjectionJacobian(calibration, p),
        vision::rightProjectionJacobian(calibration, p).topRows<1>();
    *jacobian = -by_point * vision::perturbationJacobian(p);
  }
  return calibration.project(pair.p_current) - calibration.project(p);
}

bool isProjectable(const PointPair& pair, const Eigen::Isometry3d& T_current_previous) {
  return (T_current_previous * pair.p_previous).z() >= vision::kNearestDepth_m;
}

RefinedMotion refineMotion(const RefinementParams& params, const vision::StereoCalibration& calibration,
                           const std::vector<PointPair>& pairs, const Eigen::Isometry3d& T_current_previous) {
  RefinedMotion motion;
  motion.T_current_previous = T_current_previous;
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
      linearise(params, calibration, pairs, motion.inlier, motion.T_current_previous).information;
  const Eigen::LDLT<Matrix6d> solver(information);
  motion.covariance = variance_px2 * solver.solve(Matrix6d::Identity());
  motion.converged = solver.isPositive() && motion.covariance.allFinite();
  motion.T_current_previous = renormalised(motion.T_current_previous);
  return motion;
}

}  // namespace stereo_nav::odometry
