#include "mapping/loop/loop_verification.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "mapping/loop/loop_pose.h"

namespace stereo_nav::mapping {
namespace {

/// Factor of the covariance: the landmarks of a place were seen by the same few frames, so that their errors
/// are not independent (docs/place_recognition.md).
constexpr double kDependence = 4.0;

/// Of the position, m^2.
double largestVariance(const RelativePose& pose) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(pose.covariance.topLeftCorner<3, 3>(),
                                                        Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

DescribedView viewOf(const vision::Keyframe& keyframe) {
  return {keyframe.descriptors, keyframe.corners.size()};
}

/// Notes what a stage saw. Returns whether it is enough.
bool passes(LoopStage stage, std::size_t seen, int needed, LoopCandidate& candidate) {
  candidate.stage = stage;
  candidate.figure = static_cast<double>(seen);
  candidate.bound = needed;
  return seen >= static_cast<std::size_t>(needed);
}

/// Of the matches those whose corner at the place has a depth.
std::vector<CornerMatch> matchesWithDepth(const VerificationParams& params, const vision::Keyframe& query,
                                          const vision::Keyframe& place) {
  std::vector<CornerMatch> kept;
  for (const CornerMatch& match : mutualMatches(viewOf(query), viewOf(place), params.max_distance)) {
    if (place.corners[match.place].hasDepth()) kept.push_back(match);
  }
  return kept;
}

std::vector<LandmarkMatch> landmarksOf(const vision::StereoCalibration& calibration,
                                       const vision::Keyframe& query, const vision::Keyframe& place,
                                       const std::vector<CornerMatch>& matches) {
  std::vector<LandmarkMatch> landmarks(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    setPoint(calibration, place.corners[matches[i].place], landmarks[i]);
    landmarks[i].seen = query.corners[matches[i].query];
  }
  return landmarks;
}

}  // namespace

bool verifyLoop(const VerificationParams& params, const vision::StereoCalibration& calibration,
                const KeyframeChain& chain, LoopCandidate& candidate) {
  const vision::Keyframe &query = chain[candidate.query], &place = chain[candidate.place];
  const std::vector<CornerMatch> matches = matchesWithDepth(params, query, place);
  candidate.matches = matches.size();
  if (!passes(LoopStage::kMatches, matches.size(), params.min_matches, candidate)) return false;

  const std::vector<LandmarkMatch> landmarks = landmarksOf(calibration, query, place, matches);
  const std::uint64_t seed = (static_cast<std::uint64_t>(query.id) << 32) + place.id;
  const auto pose = ransacPose(params.ransac, calibration, landmarks, seed);
  const std::size_t agreeing = pose ? pose->inliers.size() : 0;
  if (!passes(LoopStage::kPose, agreeing, params.min_pose_inliers, candidate)) return false;

  std::vector<CornerMatch> agreed;
  std::vector<LandmarkMatch> agreed_landmarks;
  for (const std::size_t i : pose->inliers) {
    agreed.push_back(matches[i]);
    agreed_landmarks.push_back(landmarks[i]);
  }
  const auto first = refineLoopPose(calibration, agreed_landmarks, pose->T_query_place);
  const auto all = searchNeighbours(params.search, calibration, chain, candidate.place, query,
                                    first ? first->T_query_place : pose->T_query_place, agreed);
  const auto refined = refineLoopPose(calibration, all, first ? first->T_query_place : pose->T_query_place);
  candidate.inliers = refined ? refined->inliers : 0;
  if (!passes(LoopStage::kInliers, candidate.inliers, params.min_inliers, candidate)) return false;
  candidate.place_query = {refined->T_query_place.inverse(), kDependence * refined->covariance};
  candidate.stage = LoopStage::kUncertainty;
  candidate.figure = std::sqrt(largestVariance(candidate.place_query));
  candidate.bound = params.max_sigma_m;
  return candidate.figure <= candidate.bound;
}

}  // namespace stereo_nav::mapping
