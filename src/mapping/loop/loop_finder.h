#pragma once

#include <deque>
#include <vector>

#include "mapping/loop/loop_candidate.h"
#include "mapping/loop/loop_params.h"
#include "mapping/loop/place_index.h"

namespace stereo_nav::mapping {

/// Finds out when a camera is back at a place that it has seen, and where it is there: retrieval by words,
/// verification by geometry, then acceptance by what the keyframes before said and by how far the odometry
/// can have drifted. Deterministic; knows no ROS. Not thread-safe.
class LoopFinder {
 public:
  /// Throws ParameterError, std::invalid_argument.
  LoopFinder(const LoopParams& params, const vision::StereoCalibration& calibration);

  /// Adds a keyframe and looks for it among the earlier ones. Returns the candidates, the most similar one
  /// first, each with the stage that accepted or rejected it. Throws std::invalid_argument as
  /// KeyframeChain::add() does.
  std::vector<LoopCandidate> add(vision::Keyframe keyframe);

  /// The first keyframe that is recent or covisible with the newest one: those before it are candidates.
  std::size_t endOfPast() const;

  const KeyframeChain& chain() const { return chain_; }
  const PlaceIndex& index() const { return index_; }

 private:
  /// Loops of the keyframes before that say the same as the candidate.
  std::size_t agreeing(const LoopCandidate& candidate) const;
  /// Decides about a candidate that geometry has verified.
  void judge(LoopCandidate& candidate) const;

  LoopParams params_;
  vision::StereoCalibration calibration_;
  KeyframeChain chain_;
  PlaceIndex index_;
  std::deque<LoopCandidate> verified_;  ///< by geometry, of the last keyframes
};

}  // namespace stereo_nav::mapping
