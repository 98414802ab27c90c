#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mapping/loop/loop_candidate.h"

namespace stereo_nav::tools {

/// What a run over a recording or a folder found.
struct LoopRun {
  std::vector<std::string> names;                  ///< of the keyframes: stamps, or files
  std::vector<mapping::LoopCandidate> candidates;  ///< in order of their queries, best first
  std::vector<std::string> notes;

  /// Whether two keyframes show the same place; empty where that is not known.
  std::function<bool(std::size_t query, std::size_t place)> is_same_place;
  /// True pose of the query in the place's camera; nothing where it is not known.
  std::function<std::optional<Eigen::Isometry3d>(std::size_t query, std::size_t place)> true_pose;
  std::vector<std::size_t> past_end;  ///< of each keyframe: how many before it are candidates

  /// Picture of the matches of a candidate.
  std::function<cv::Mat(const mapping::LoopCandidate&)> picture;

  std::size_t index_bytes = 0;
  std::vector<double> describe_ms, retrieval_ms,
      loop_ms;  ///< processor time a keyframe; loop: with retrieval
};

}  // namespace stereo_nav::tools
