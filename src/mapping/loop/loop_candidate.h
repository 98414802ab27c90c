#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "mapping/loop/keyframe_chain.h"

namespace stereo_nav::mapping {

/// How far a candidate came: the stage that rejected it, or acceptance.
enum class LoopStage { kMatches, kPose, kInliers, kUncertainty, kDrift, kConsistency, kAccepted };

/// "matches", "pose", "inliers", "uncertainty", "drift", "consistency", "accepted".
const char* nameOf(LoopStage stage);

/// A place that may be the one where the query is, and what became of it.
struct LoopCandidate {
  std::size_t query = 0, place = 0;  ///< positions in the chain
  std::uint32_t query_id = 0, place_id = 0;
  double score = 0.0;  ///< of the retrieval
  LoopStage stage = LoopStage::kMatches;
  double figure = 0.0, bound = 0.0;  ///< what the stage saw, and what it asked for
  std::size_t matches = 0;           ///< mutual ones of the descriptors
  std::size_t inliers = 0;           ///< after the search among the neighbours' landmarks
  RelativePose place_query;  ///< pose of the query in the place's camera, from the stage kUncertainty on
  double drift_chi2 = 0.0;   ///< against the odometry, 6 degrees of freedom; NaN: it knows nothing

  bool accepted() const { return stage == LoopStage::kAccepted; }
  bool hasPose() const { return stage >= LoopStage::kUncertainty; }
  /// What decided, in words.
  std::string reason() const;
};

}  // namespace stereo_nav::mapping
