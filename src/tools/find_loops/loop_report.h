#pragma once

#include <string>

#include "tools/find_loops/loop_run.h"

namespace stereo_nav::tools {

/// Figures of a run. Those of the truth are zero where it is not known.
struct LoopFigures {
  std::size_t keyframes = 0, candidates = 0, accepted = 0;
  bool has_truth = false;
  std::size_t revisits = 0;        ///< keyframes that show a place which is among their candidates
  std::size_t first_is_same = 0;   ///< of these, whose most similar place is the same one (recall@1)
  std::size_t recognised = 0;      ///< of these, with an accepted true loop
  std::size_t found_in_time = 0;   ///< of these, with one in their own keyframe or the two after it
  std::size_t false_accepted = 0;  ///< accepted loops of another place
  std::size_t posed = 0;           ///< accepted loops whose true pose is known
  double worst_translation_m = 0.0, worst_rotation_deg = 0.0;
  double rms_translation_m = 0.0, rms_rotation_deg = 0.0;
  double nees_mean = 0.0;  ///< 6 expected
  double index_bytes_per_keyframe = 0.0;
};

LoopFigures figuresOf(const LoopRun& run);

/// summary.json: the same in each run.
std::string toJson(const LoopFigures& figures, const std::string& input);
/// timing.json: processor times, ms.
std::string timingJson(const LoopRun& run);
/// loops.csv: each candidate with the stage that decided.
std::string toCsv(const LoopRun& run);
void print(const LoopFigures& figures, const LoopRun& run, const std::string& input);

}  // namespace stereo_nav::tools
