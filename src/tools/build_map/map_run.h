#pragma once

#include <functional>
#include <string>
#include <vector>

#include "stereo_nav/eval/evaluation.h"
#include "tools/build_map/map_builder.h"
#include "tools/common/recorded_keyframes.h"

namespace stereo_nav::tools {

struct BuildMapOptions {
  KeyframeRunOptions run;
  std::string output;  ///< folder
  mapping::LoopParams loop;
  mapping::RobustParams closing;
};

/// A map, and the way of base_link before its loops were closed and after.
struct MapRun {
  mapping::VisualMap map;
  std::vector<mapping::LoopVerdict> verdicts;
  std::vector<mapping::LoopCandidate> candidates;
  eval::EvaluationInput before, after;
  std::vector<std::string> notes;
  double keyframe_ms = 0.0;  ///< processor time a keyframe, description and recognition
  double closing_ms = 0.0;   ///< processor time of closing all loops
};

/// Throws InputError, ParameterError.
MapRun buildMap(const BuildMapOptions& options,
                const std::function<void(std::size_t done, std::size_t all)>& progress);

}  // namespace stereo_nav::tools
