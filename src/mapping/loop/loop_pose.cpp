#include "mapping/loop/loop_pose.h"

#include <algorithm>
#include <cmath>

#include "core/gauss_newton.h"
#include "core/statistics.h"

namespace stereo_nav::mapping {
namespace {

constexpr int kIterations = 10;
constexpr double kSmallStep = 1e-7;
constexpr double kLossScale = 2.0;  ///< of the Cauchy loss, in standard deviations
constexpr std::size_t kFewest = 6;

/// Weight by the Cauchy loss of a residual whose squared length, in units of its noise, is `squared`.
double weightOf(double squared) {
  return 1.0 / (1.0 + squared / (kLossScale * kLossScale));
}

struct NormalEquations {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
};

NormalEquations linearise(const vision::StereoCalibration& calibration,
                          const std::vector<LandmarkMatch>& matches, const Eigen::Isometry3d& T) {
  NormalEquations equations;
  for (const LandmarkMatch& match : matches) {
    const auto residual = residualOf(calibration, T, match);
    if (!residual) continue;
    const Eigen::Matrix<double, 6, 3> weighted =
        weightOf(residual->squared) * residual->by_pose.transpose() * residual->information;
    equations.information.noalias() += weighted * residual->by_pose;
    equations.gradient.noalias() -= weighted * residual->error;  // the residual falls as the projection rises
  }
  return equations;
}

/// Marks the inliers. Returns the factor by which the inverse of the weighted information becomes the
/// covariance of the robust estimate: E[psi^2] / E[psi']^2, with the information counted per weight.
double judge(const vision::StereoCalibration& calibration, const std::vector<LandmarkMatch>& matches,
             LoopPose& pose) {
  constexpr double kShare = 0.99;
  double influence_squares = 0.0, slope = 0.0, weights = 0.0, coordinates = 0.0;
  pose.inlier.assign(matches.size(), false);
  pose.inliers = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const auto residual = residualOf(calibration, pose.T_query_place, matches[i]);
    if (!residual || residual->squared > chiSquareQuantile(residual->dimensions, kShare)) continue;
    pose.inlier[i] = true;
    ++pose.inliers;
    const double weight = weightOf(residual->squared), fields = residual->dimensions;
    influence_squares += weight * weight * residual->squared;
    slope += fields * weight - 2.0 * weight * weight * residual->squared / (kLossScale * kLossScale);
    weights += fields * weight;
    coordinates += fields;
  }
  slope = std::max(slope, 0.1 * weights);  // no sum of slopes that outliers could bring to zero
  const double spare = std::max(1.0, coordinates - 6.0);
  return influence_squares * weights * coordinates / (slope * slope * spare);
}

}  // namespace

std::optional<LoopPose> refineLoopPose(const vision::StereoCalibration& calibration,
                                       const std::vector<LandmarkMatch>& matches,
                                       const Eigen::Isometry3d& T_query_place) {
  LoopPose pose;
  pose.T_query_place = T_query_place;
  NormalEquations equations;
  for (int i = 0; i < kIterations; ++i) {
    equations = linearise(calibration, matches, pose.T_query_place);
    const auto step = gaussNewtonStep<Matrix6d, Vector6d>(equations.information, equations.gradient);
    if (!step) return std::nullopt;
    pose.T_query_place = renormalised(expMotion(*step) * pose.T_query_place);
    if (step->norm() < kSmallStep) break;
  }
  const double factor = judge(calibration, matches, pose);
  if (pose.inliers < kFewest) return std::nullopt;
  pose.covariance = factor * equations.information.ldlt().solve(Matrix6d::Identity());
  if (!pose.covariance.allFinite()) return std::nullopt;
  return pose;
}

}  // namespace stereo_nav::mapping
