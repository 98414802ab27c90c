#include "odometry/laser/range_flow.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <optional>

#include "core/planar_motion.h"
#include "core/statistics.h"

namespace stereo_nav::odometry {
namespace {

constexpr int kMostReweightings = 10;
constexpr double kSteady = 1e-4;  // m/s, rad/s
constexpr std::size_t kLeastEquations = 10;
/// Of the pre-weighting: its floor, and what second derivatives count compared with first ones.
constexpr double kFloor_m2 = 1e-4;
constexpr double kSecondOrder = 1.0;
/// With this multiple of the residuals' standard deviation Cauchy's estimator is 95 % efficient on normal
/// noise.
constexpr double kCauchySigmas = 2.385;
constexpr double kSigmasOfMedian = 1.4826;
/// The motion filter's constant weight on the coarsest level; on each finer one both weights are smaller by
/// e.
constexpr double kConstantWeight = 0.05;
/// What a velocity changes by within 1 s, m/s or rad/s; it grows with the root of the time.
constexpr double kVelocityWalk = 0.5;
/// Of a velocity that no scan tells, m/s and rad/s.
constexpr double kUnknown = 1.0;

/// What one beam tells of the velocity: `coefficients` * velocity + range_rate = 0.
struct FlowEquation {
  Eigen::RowVector3d coefficients;
  double range_rate;
};

/// The derivatives of R(t, alpha) halfway between two scans; NaN where a neighbour has no range.
struct Derivatives {
  Derivatives(const RangeScan& before, const RangeScan& after, double duration_s) : mean(before) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    by_time.assign(mean.size(), none);
    by_beam.assign(mean.size(), none);
    for (std::size_t i = 0; i < mean.size(); ++i) {
      mean.ranges_m[i] = 0.5 * (before.ranges_m[i] + after.ranges_m[i]);
      by_time[i] = (after.ranges_m[i] - before.ranges_m[i]) / duration_s;
    }
    for (std::size_t i = 1; i + 1 < mean.size(); ++i) by_beam[i] = slope(i);
  }

  /// Of the differences to both neighbours that to the nearer one counts more: the other may lie on another
  /// surface.
  double slope(std::size_t i) const {
    const std::vector<double>& r = mean.ranges_m;
    const double to_last = (mean.point(i) - mean.point(i - 1)).norm();
    const double to_next = (mean.point(i + 1) - mean.point(i)).norm();
    return (to_next * (r[i] - r[i - 1]) + to_last * (r[i + 1] - r[i])) / (to_last + to_next);
  }

  /// Central differences.
  static double change(const std::vector<double>& values, std::size_t i) {
    return 0.5 * (values[i + 1] - values[i - 1]);
  }

  RangeScan mean;
  std::vector<double> by_time;  ///< m/s
  std::vector<double> by_beam;  ///< m
};

/// The range flow constraint of each beam, weighted by how linear the range function is there. With the
/// beam's direction theta, range r and k = d alpha / d theta:
///   (cos + R_alpha k sin / r) v_x + (sin - R_alpha k cos / r) v_y - R_alpha k omega + R_t = 0.
std::vector<FlowEquation> flowEquations(const RangeScan& before, const RangeScan& after, double duration_s) {
  const Derivatives R(before, after, duration_s);
  const double dt2 = duration_s * duration_s;
  std::vector<FlowEquation> equations;
  for (std::size_t i = 1; i + 1 < R.mean.size(); ++i) {
    const double r = R.mean.ranges_m[i], by_time = R.by_time[i], by_beam = R.by_beam[i];
    const double bend = Derivatives::change(R.by_beam, i), turn = Derivatives::change(R.by_time, i);
    const double spread = kFloor_m2 + by_beam * by_beam + dt2 * by_time * by_time +
                          kSecondOrder * (bend * bend + dt2 * turn * turn);
    if (!std::isfinite(spread)) continue;
    const double weight = 1.0 / std::sqrt(spread);
    const double theta = R.mean.direction_rad(i), c = std::cos(theta), s = std::sin(theta);
    const double by_angle = by_beam / R.mean.increment_rad;
    equations.push_back({weight * Eigen::RowVector3d(c + by_angle * s / r, s - by_angle * c / r, -by_angle),
                         weight * by_time});
  }
  return equations;
}

/// The velocity that the equations agree on, by iteratively reweighted least squares with Cauchy's loss.
LaserVelocity solveFlow(const std::vector<FlowEquation>& equations) {
  LaserVelocity result;
  double scale = std::numeric_limits<double>::infinity();  // the first solution counts all alike
  for (int iteration = 0; iteration < kMostReweightings; ++iteration) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    double weighted_squares = 0.0;
    std::size_t inliers = 0;
    std::vector<double> magnitudes;
    for (const FlowEquation& equation : equations) {
      const double residual = equation.coefficients.dot(result.mean) + equation.range_rate;
      const double weight = 1.0 / (1.0 + residual * residual / (scale * scale));
      information += weight * equation.coefficients.transpose() * equation.coefficients;
      gradient += weight * residual * equation.coefficients.transpose();
      weighted_squares += weight * residual * residual;
      inliers += weight >= 0.5 ? 1 : 0;
      magnitudes.push_back(std::abs(residual));
    }
    const auto count = static_cast<double>(equations.size());
    const Eigen::LDLT<Eigen::Matrix3d> solver(information + 1e-9 * Eigen::Matrix3d::Identity());
    const Eigen::Vector3d step = solver.solve(-gradient);
    result.mean += step;
    result.covariance = weighted_squares / (count - 3.0) * solver.solve(Eigen::Matrix3d::Identity());
    result.inlier_share = static_cast<double>(inliers) / count;
    if (iteration > 0 && step.norm() < kSteady) break;
    for (std::size_t i = 0; i < equations.size(); ++i)
      magnitudes[i] = std::abs(equations[i].coefficients.dot(result.mean) + equations[i].range_rate);
    scale = std::max(1e-6, kCauchySigmas * kSigmasOfMedian * upperMedian(magnitudes));
  }
  return result;
}

/// Along eigenvectors of the covariance the velocity stays the more that of before, the less it is known:
/// compared with what it may have changed by since then.
Eigen::Vector3d filtered(const LaserVelocity& now, const Eigen::Vector3d& before, double duration_s,
                         double level_factor) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(now.covariance);
  const Eigen::Matrix3d& E = solver.eigenvectors();
  const double change = kVelocityWalk * kVelocityWalk * duration_s;
  const Eigen::Array3d inertia =
      level_factor * (kConstantWeight + solver.eigenvalues().array().max(0.0) / change);
  const Eigen::Array3d mixed =
      (E.transpose() * now.mean).array() + inertia * (E.transpose() * before).array();
  return E * (mixed / (1.0 + inertia)).matrix();
}

LaserVelocity unknownVelocity() {
  LaserVelocity result;
  result.covariance = kUnknown * kUnknown * Eigen::Matrix3d::Identity();
  return result;
}

}  // namespace

LaserVelocity RangeFlow::follow(const RangeScan& scan, double duration_s) {
  const std::vector<RangeScan> before = std::move(before_);
  before_ = rangePyramid(scan);
  const Eigen::Vector3d last_velocity = velocity_;
  velocity_.setZero();
  if (before.empty() || !before.front().comparable(before_.front())) return unknownVelocity();
  LaserVelocity result = unknownVelocity();
  double level_factor = 1.0;
  for (std::size_t level = before_.size(); level-- > 0; level_factor *= std::exp(-1.0)) {
    const Eigen::Isometry2d T_before_now = expPlanar(duration_s * velocity_);
    const std::vector<FlowEquation> equations =
        flowEquations(before[level], warped(before_[level], T_before_now), duration_s);
    if (equations.size() < kLeastEquations) {
      if (level == 0) return unknownVelocity();
      continue;
    }
    result = solveFlow(equations);
    result.mean = logPlanar(expPlanar(duration_s * result.mean) * T_before_now) / duration_s;
    velocity_ = filtered(result, last_velocity, duration_s, level_factor);
  }
  result.mean = velocity_;
  return result;
}

}  // namespace stereo_nav::odometry
