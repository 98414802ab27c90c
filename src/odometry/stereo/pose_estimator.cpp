#include "odometry/stereo/pose_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/gauss_newton.h"

namespace stereo_nav::odometry {
namespace {

using Vector12d = Eigen::Matrix<double, 12, 1>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;

constexpr std::size_t kFewestPoints = 3;

/// Over the perturbations of T_camera_world (first 6) and T_late_camera (last 6).
struct NormalEquations {
  Matrix12d information = Matrix12d::Zero();
  Vector12d gradient = Vector12d::Zero();
};

void addRotationPrior(const Eigen::Matrix3d& R, const Eigen::Matrix3d& R_measured, double sigma_rad,
                      int first, NormalEquations& equations) {
  const Eigen::Vector3d residual = logRotation(R * R_measured.transpose());
  const double weight = 1.0 / (sigma_rad * sigma_rad);
  equations.information.block<3, 3>(first, first).diagonal().array() += weight;
  equations.gradient.segment<3>(first) += weight * residual;
}

/// T_late_camera is expected to be the twist extrapolated from this very motion, over the time offset.
void addTimeOffsetPrior(const MotionPrior& prior, const vision::StereoView& view,
                        NormalEquations& equations) {
  const Eigen::Isometry3d T_current_previous = view.T_camera_world * prior.T_previous_world.inverse();
  const Vector6d twist = extrapolatedTwist(T_current_previous, prior.interval_s, prior.previous_twist);
  const Vector6d late = logMotion(view.T_late_camera);
  const Vector6d residual = late - prior.right_time_offset_s * twist;
  const double gain = prior.previous_twist ? 1.5 : 1.0;
  Eigen::Matrix<double, 6, 12> jacobian;
  jacobian.leftCols<6>() = -gain * prior.right_time_offset_s / prior.interval_s *
                           inverseLeftJacobian(logMotion(T_current_previous));
  jacobian.rightCols<6>() = inverseLeftJacobian(late);
  const Vector6d weight = (prior.twist_sigma * prior.right_time_offset_s).array().square().inverse();
  equations.information += jacobian.transpose() * weight.asDiagonal() * jacobian;
  equations.gradient += jacobian.transpose() * (weight.asDiagonal() * residual);
}

void addPriors(const MotionPrior& prior, const vision::StereoView& view, NormalEquations& equations) {
  // Image residuals are weighted as if their noise were 1 px, and so are the priors.
  constexpr double kVariance_px2 = vision::kPixelSigma_px * vision::kPixelSigma_px;
  NormalEquations added;
  if (prior.R_current_previous) {
    const Eigen::Matrix3d R = view.T_camera_world.linear() * prior.T_previous_world.linear().transpose();
    addRotationPrior(R, *prior.R_current_previous, prior.rotation_sigma_rad, 3, added);
  }
  if (prior.right_time_offset_s != 0.0) {
    addTimeOffsetPrior(prior, view, added);
    if (prior.R_late_camera) {
      addRotationPrior(view.T_late_camera.linear(), *prior.R_late_camera, prior.rotation_sigma_rad, 9, added);
    }
  }
  equations.information += kVariance_px2 * added.information;
  equations.gradient += kVariance_px2 * added.gradient;
}

/// Sums over the reliable observations, with the Cauchy loss of scale `loss_px`.
NormalEquations linearise(const vision::StereoCalibration& calibration,
                          const std::vector<MapObservation>& observations, bool has_time_offset,
                          double loss_px, const vision::StereoView& view) {
  NormalEquations equations;
  vision::ViewResidual residual;
  for (const MapObservation& observation : observations) {
    if (!observation.reliable ||
        !vision::viewResidual(calibration, view, observation.p_world, observation.seen, residual))
      continue;
    const double weight = vision::robustWeight(residual.error_px, observation.seen.noise, loss_px);
    const Eigen::Matrix<double, 4, 6> weighted = weight * residual.by_pose;
    equations.information.topLeftCorner<6, 6>().noalias() += weighted.transpose() * residual.by_pose;
    equations.gradient.head<6>().noalias() += weighted.transpose() * residual.error_px;
    if (!has_time_offset || !observation.seen.has_right) continue;
    const Eigen::Matrix<double, 2, 6> weighted_late = weight * residual.by_late;
    equations.information.bottomLeftCorner<6, 6>().noalias() +=
        weighted_late.transpose() * residual.by_pose.bottomRows<2>();
    equations.information.bottomRightCorner<6, 6>().noalias() += weighted_late.transpose() * residual.by_late;
    equations.gradient.tail<6>().noalias() += weighted_late.transpose() * residual.error_px.tail<2>();
  }
  equations.information.topRightCorner<6, 6>() =
      equations.information.bottomLeftCorner<6, 6>().transpose().eval();
  return equations;
}

/// The factor by which the inverse of the weighted information becomes the covariance of the robust estimate:
/// E[psi^2] / E[psi']^2, with the information counted per weight (Huber 1981, chapter 7).
class RobustNoise {
 public:
  explicit RobustNoise(double loss_px) : loss_px_(loss_px) {}

  void add(const Eigen::Vector4d& error_px, double coordinates) {
    const double squares = error_px.squaredNorm();
    const double weight = vision::robustWeight(error_px, 1.0, loss_px_);
    influence_squares_ += weight * weight * squares;
    slope_ += coordinates * weight - 2.0 * weight * weight * squares / (loss_px_ * loss_px_);
    weight_ += coordinates * weight;
    coordinates_ += coordinates;
  }

  /// `unknowns` that were fitted to the observations, px^2.
  double variance(int unknowns) const {
    const double spare = std::max(1.0, coordinates_ - unknowns);
    // No sum of slopes that a handful of outliers could bring to zero.
    const double slope = std::max(slope_, 0.1 * weight_);
    return influence_squares_ * weight_ * coordinates_ / (slope * slope * spare);
  }

 private:
  double loss_px_;
  double influence_squares_ = 0.0;
  double slope_ = 0.0;
  double weight_ = 0.0;
  double coordinates_ = 0.0;
};

}  // namespace

void PoseEstimatorParams::describe(ParameterVisitor& visitor) {
  visitor.integer("iterations", iterations, {1, 100}, "", "most Gauss-Newton iterations");
  visitor.real("loss_px", loss_px, {0.01, 100.0}, "px", "scale of the Cauchy loss on reprojection errors");
  visitor.real("max_error_px", max_error_px, {0.01, 100.0}, "px", "reprojection error of an inlier at most");
}

std::optional<PoseEstimator::Matrix12d> PoseEstimator::minimise(
    const std::vector<MapObservation>& observations, const MotionPrior& prior, int unknowns,
    vision::StereoView& view) const {
  NormalEquations equations;
  for (int iteration = 0; iteration < params_.iterations; ++iteration) {
    // Graduated: a wide loss first, so that a poor guess does not make outliers of good points.
    const double loss_px = params_.loss_px * std::max(1.0, 8.0 / (1 << iteration));
    equations = linearise(calibration_, observations, unknowns > 6, loss_px, view);
    addPriors(prior, view, equations);
    const auto reduced = gaussNewtonStep<Eigen::MatrixXd, Eigen::VectorXd>(
        equations.information.topLeftCorner(unknowns, unknowns), equations.gradient.head(unknowns));
    if (!reduced) return std::nullopt;
    Vector12d step = Vector12d::Zero();
    step.head(unknowns) = *reduced;
    view.T_camera_world = expMotion(step.head<6>()) * view.T_camera_world;
    view.T_late_camera = expMotion(step.tail<6>()) * view.T_late_camera;
    if (step.norm() < 1e-6 && iteration >= 4) break;
  }
  return equations.information;
}

double PoseEstimator::judge(const std::vector<MapObservation>& observations, int unknowns,
                            PoseEstimate& estimate) const {
  double squares = 0.0;
  double coordinates = 0.0;
  RobustNoise noise(params_.loss_px);
  vision::ViewResidual residual;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const MapObservation& observation = observations[i];
    if (!vision::viewResidual(calibration_, estimate.view, observation.p_world, observation.seen, residual))
      continue;
    estimate.error_px[i] = std::max(residual.error_px.head<2>().norm(), residual.error_px.tail<2>().norm());
    if (estimate.error_px[i] > params_.max_error_px) continue;
    estimate.inlier[i] = true;
    ++estimate.inliers;
    const double seen = observation.seen.has_right ? 4.0 : 2.0;
    squares += residual.error_px.squaredNorm();
    coordinates += seen;
    if (observation.reliable) noise.add(residual.error_px / observation.seen.noise, seen);
  }
  if (estimate.inliers > 0) estimate.rms_px = std::sqrt(squares / coordinates);
  return noise.variance(unknowns);
}

PoseEstimate PoseEstimator::estimate(const std::vector<MapObservation>& observations,
                                     const MotionPrior& prior, const vision::StereoView& guess) const {
  PoseEstimate estimate;
  estimate.view = guess;
  estimate.error_px.assign(observations.size(), std::numeric_limits<double>::infinity());
  estimate.inlier.assign(observations.size(), false);
  const int unknowns = prior.right_time_offset_s != 0.0 ? 12 : 6;
  const auto information = minimise(observations, prior, unknowns, estimate.view);
  if (!information) return estimate;
  estimate.variance_px2 = judge(observations, unknowns, estimate);
  if (estimate.inliers < kFewestPoints) return estimate;
  const Eigen::LDLT<Eigen::MatrixXd> solver(information->topLeftCorner(unknowns, unknowns));
  const Eigen::MatrixXd inverse = solver.solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  estimate.covariance = estimate.variance_px2 * inverse.topLeftCorner<6, 6>();
  estimate.view.T_camera_world = renormalised(estimate.view.T_camera_world);
  estimate.view.T_late_camera = renormalised(estimate.view.T_late_camera);
  estimate.converged = estimate.covariance.allFinite();
  return estimate;
}

}  // namespace stereo_nav::odometry
