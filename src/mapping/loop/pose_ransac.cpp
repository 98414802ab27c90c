#include "mapping/loop/pose_ransac.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>

namespace stereo_nav::mapping {
namespace {

constexpr std::size_t kSample = 4;

using Sample = std::array<std::size_t, kSample>;

/// Four different indices below `count`.
Sample drawSample(std::mt19937_64& random, std::size_t count) {
  Sample sample{};
  for (std::size_t i = 0; i < kSample;) {
    sample[i] = random() % count;
    if (std::find(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(i), sample[i]) ==
        sample.begin() + static_cast<std::ptrdiff_t>(i))
      ++i;
  }
  return sample;
}

std::vector<Eigen::Isometry3d> threePointPoses(const vision::StereoCalibration& calibration,
                                               const std::vector<LandmarkMatch>& matches,
                                               const Sample& sample) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> rays;
  for (std::size_t i = 0; i < 3; ++i) {
    const LandmarkMatch& match = matches[sample[i]];
    points.emplace_back(match.p_place.x(), match.p_place.y(), match.p_place.z());
    rays.emplace_back((match.seen.px.x() - calibration.cx) / calibration.fx,
                      (match.seen.px.y() - calibration.cy) / calibration.fy);
  }
  std::vector<cv::Mat> turns, shifts;
  cv::solveP3P(points, rays, cv::Matx33d::eye(), cv::noArray(), turns, shifts, cv::SOLVEPNP_P3P);
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const auto turn = turns[i].ptr<double>(), shift = shifts[i].ptr<double>();
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = expRotation({turn[0], turn[1], turn[2]});
    T.translation() << shift[0], shift[1], shift[2];
    if (T.matrix().allFinite()) poses.push_back(T);
  }
  return poses;
}

/// Column and row within the bound, and the disparity likewise with its own noise besides.
bool agrees(const RansacParams& params, const vision::StereoCalibration& calibration,
            const Eigen::Isometry3d& T_query_place, const LandmarkMatch& match) {
  const Eigen::Vector3d p_query = T_query_place * match.p_place;
  if (p_query.z() <= 0.0) return false;
  const Eigen::Vector3d projected = measurementOf(calibration, p_query);
  if ((match.seen.px - projected.head<2>()).norm() > params.max_error_px) return false;
  if (!match.seen.hasDepth()) return true;
  const double bound_px = params.max_error_px + 3.0 * match.seen.disparity_sigma_px;
  return std::abs(match.seen.disparity_px - projected.z()) <= bound_px;
}

double errorOf(const vision::StereoCalibration& calibration, const Eigen::Isometry3d& T_query_place,
               const LandmarkMatch& match) {
  const Eigen::Vector3d p_query = T_query_place * match.p_place;
  if (p_query.z() <= 0.0) return std::numeric_limits<double>::infinity();
  return (match.seen.px - measurementOf(calibration, p_query).head<2>()).norm();
}

/// Samples after which 99.9 % of the runs have met one of inliers alone.
int samplesNeeded(std::size_t inliers, std::size_t matches, int most) {
  const double share = static_cast<double>(inliers) / static_cast<double>(matches);
  const double hit = std::pow(share, static_cast<double>(kSample));
  if (hit >= 1.0) return 1;
  const double needed = std::log(1e-3) / std::log1p(-hit);
  return needed < most ? static_cast<int>(std::ceil(needed)) : most;
}

}  // namespace

void RansacParams::describe(ParameterVisitor& visitor) {
  visitor.integer("iterations", iterations, {1, 100000}, "", "most samples of three matches for a pose");
  visitor.real("max_error_px", max_error_px, {0.1, 100.0}, "px",
               "distance between a corner and its projected landmark at which they agree");
}

std::optional<RansacPose> ransacPose(const RansacParams& params, const vision::StereoCalibration& calibration,
                                     const std::vector<LandmarkMatch>& matches, std::uint64_t seed) {
  if (matches.size() < kSample) return std::nullopt;
  std::mt19937_64 random(seed);
  RansacPose best;
  int needed = params.iterations;
  for (int i = 0; i < needed; ++i) {
    const Sample sample = drawSample(random, matches.size());
    const auto poses = threePointPoses(calibration, matches, sample);
    const auto pose = std::min_element(poses.begin(), poses.end(), [&](const auto& a, const auto& b) {
      return errorOf(calibration, a, matches[sample[3]]) < errorOf(calibration, b, matches[sample[3]]);
    });
    if (pose == poses.end() || !agrees(params, calibration, *pose, matches[sample[3]])) continue;
    std::vector<std::size_t> inliers;
    for (std::size_t k = 0; k < matches.size(); ++k) {
      if (agrees(params, calibration, *pose, matches[k])) inliers.push_back(k);
    }
    if (inliers.size() <= best.inliers.size()) continue;
    best = {*pose, std::move(inliers)};
    needed = samplesNeeded(best.inliers.size(), matches.size(), params.iterations);
  }
  if (best.inliers.size() < kSample) return std::nullopt;
  return best;
}

}  // namespace stereo_nav::mapping
