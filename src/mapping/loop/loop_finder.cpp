#include "mapping/loop/loop_finder.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/statistics.h"
#include "mapping/loop/loop_verification.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::mapping {
namespace {

constexpr int kFields = 6;
constexpr std::size_t kCovisible = 10;  ///< landmarks that two keyframes of one place have in common

/// Squared distance between two accounts of one pose, in units of what both are uncertain by.
double chiSquare(const RelativePose& a, const RelativePose& b) {
  const Vector6d difference = logMotion(a.T.inverse() * b.T);
  const Matrix6d covariance = a.covariance + b.covariance;
  return difference.dot(covariance.ldlt().solve(difference));
}

}  // namespace

LoopFinder::LoopFinder(const LoopParams& params, const vision::StereoCalibration& calibration)
    : params_(params), calibration_(calibration), chain_(params.drift), index_(params.retrieval) {
  validateParameters(params, "loop");
  calibration.validate();
}

std::vector<LoopCandidate> LoopFinder::add(vision::Keyframe keyframe) {
  chain_.add(std::move(keyframe));
  const std::size_t query = chain_.size() - 1;
  const std::vector<vision::Descriptor>& descriptors = chain_[query].descriptors;
  std::vector<LoopCandidate> candidates;
  for (const Retrieved& retrieved : index_.query(descriptors, endOfPast())) {
    LoopCandidate candidate;
    candidate.query = query;
    candidate.place = retrieved.place;
    candidate.query_id = chain_[query].id;
    candidate.place_id = chain_[retrieved.place].id;
    candidate.score = retrieved.score;
    candidate.drift_chi2 = std::numeric_limits<double>::quiet_NaN();
    if (verifyLoop(params_.verification, calibration_, chain_, candidate)) judge(candidate);
    candidates.push_back(candidate);
  }
  index_.add(descriptors);
  for (const LoopCandidate& candidate : candidates) {
    // One that the drift forbids must not speak for others.
    if (candidate.stage == LoopStage::kConsistency || candidate.accepted()) verified_.push_back(candidate);
  }
  const auto within = static_cast<std::size_t>(params_.acceptance.within_keyframes);
  while (!verified_.empty() && verified_.front().query + within <= query) verified_.pop_front();
  return candidates;
}

std::size_t LoopFinder::endOfPast() const {
  const std::size_t query = chain_.size() - 1;
  const auto recent = static_cast<std::size_t>(params_.retrieval.exclude_recent);
  std::size_t end = query < recent ? 0 : query - recent;
  // What lies far ahead in a corridor is seen from all of it, and makes none of it the same place.
  while (end > 0 && chain_.sharedLandmarks(end - 1, query) >= kCovisible) --end;
  return end;
}

std::size_t LoopFinder::agreeing(const LoopCandidate& candidate) const {
  const double bound = chiSquareQuantile(kFields, params_.acceptance.consistency_share);
  std::size_t agreeing = 0;
  const auto near = 2 * static_cast<std::size_t>(params_.acceptance.within_keyframes);
  for (const LoopCandidate& earlier : verified_) {
    // Places of two laps are as uncertain against each other as the way between them: they would agree with
    // anything.
    if (std::max(earlier.place, candidate.place) - std::min(earlier.place, candidate.place) > near) continue;
    const auto between_places = chain_.relative(candidate.place, earlier.place);
    const auto between_queries = chain_.relative(earlier.query, candidate.query);
    if (!between_places || !between_queries) continue;
    const RelativePose expected = composed(composed(*between_places, earlier.place_query), *between_queries);
    if (chiSquare(expected, candidate.place_query) <= bound) ++agreeing;
  }
  return agreeing;
}

void LoopFinder::judge(LoopCandidate& candidate) const {
  const AcceptanceParams& params = params_.acceptance;
  if (const auto by_odometry = chain_.relative(candidate.place, candidate.query)) {
    candidate.drift_chi2 = chiSquare(*by_odometry, candidate.place_query);
    candidate.stage = LoopStage::kDrift;
    candidate.figure = candidate.drift_chi2;
    candidate.bound = chiSquareQuantile(kFields, params.drift_share);
    if (!(candidate.figure <= candidate.bound)) return;
  }
  candidate.stage = LoopStage::kConsistency;
  candidate.figure = static_cast<double>(agreeing(candidate));
  candidate.bound = params.agreeing;
  if (candidate.figure < candidate.bound) return;
  candidate.stage = LoopStage::kAccepted;
}

}  // namespace stereo_nav::mapping
