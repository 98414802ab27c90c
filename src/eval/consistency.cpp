#include "eval/consistency.h"

#include <Eigen/Cholesky>

#include "core/statistics.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::eval {
namespace {

/// Noise of the relative pose of the truth, axes of its end.
Matrix6d truthNoise(const EvaluationInput& input, const Eigen::Isometry3d& T_from_to) {
  Vector6d variances;
  variances.head<3>().setConstant(input.truth_sigma_m * input.truth_sigma_m);
  variances.tail<3>().setConstant(input.truth_sigma_rad * input.truth_sigma_rad);
  const Matrix6d noise = variances.asDiagonal();
  const Matrix6d carry = adjoint(T_from_to.inverse());
  return carry * noise * carry.transpose() + noise;
}

/// Of the given axes alone.
double squared(const Vector6d& error, const Matrix6d& covariance, const std::vector<Eigen::Index>& axes) {
  const auto n = static_cast<Eigen::Index>(axes.size());
  Eigen::VectorXd e(n);
  Eigen::MatrixXd P(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    e(i) = error(axes[static_cast<std::size_t>(i)]);
    for (Eigen::Index j = 0; j < n; ++j)
      P(i, j) = covariance(axes[static_cast<std::size_t>(i)], axes[static_cast<std::size_t>(j)]);
  }
  return e.dot(P.ldlt().solve(e));
}

}  // namespace

KnownAxes knownAxes(bool planar) {
  if (planar) return {{0, 1, 5}, {0, 1}, {5}};
  return {{0, 1, 2, 3, 4, 5}, {0, 1, 2}, {3, 4, 5}};
}

Nees neesOver(double interval_s, const EvaluationInput& input) {
  const KnownAxes axes = knownAxes(input.planar);
  Nees nees;
  nees.expected = static_cast<int>(axes.all.size());
  nees.expected_translation = static_cast<int>(axes.translation.size());
  nees.expected_rotation = static_cast<int>(axes.rotation.size());
  const double inside_95 = chiSquareQuantile(nees.expected, 0.95);
  double all = 0.0, translation = 0.0, rotation = 0.0, inside = 0.0;
  std::optional<std::size_t> from;
  std::optional<Eigen::Isometry3d> truth_from;
  for (std::size_t to = 0; to < input.frames.size(); ++to) {
    const FrameRecord& frame = input.frames[to];
    if (from && frame.time_s < input.frames[*from].time_s + interval_s - 1e-3) continue;
    const auto truth_to = frame.T_odom_base ? poseAt(input.ground_truth, frame.time_s) : std::nullopt;
    if (from && truth_to) {
      const Eigen::Isometry3d estimate = input.frames[*from].T_odom_base->inverse() * *frame.T_odom_base;
      const Eigen::Isometry3d truth = truth_from->inverse() * *truth_to;
      const Vector6d error = logMotion(estimate.inverse() * truth);
      const Matrix6d covariance = input.relative_covariance(*from, to) + truthNoise(input, estimate);
      const double value = squared(error, covariance, axes.all);
      all += value;
      translation += squared(error, covariance, axes.translation);
      rotation += squared(error, covariance, axes.rotation);
      inside += value <= inside_95 ? 1.0 : 0.0;
      ++nees.pairs;
    }
    if (!truth_to) continue;
    from = to;
    truth_from = truth_to;
  }
  if (nees.pairs == 0) return nees;
  const auto n = static_cast<double>(nees.pairs);
  nees.mean = all / n;
  nees.translation = translation / n;
  nees.rotation = rotation / n;
  nees.inside_95_percent = 100.0 * inside / n;
  return nees;
}

}  // namespace stereo_nav::eval
