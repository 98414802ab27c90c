#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "stereo_nav/eval/evaluation.h"
#include "tools/evaluate/evaluate_options.h"

namespace stereo_nav::tools {

struct EvaluationRun {
  eval::EvaluationInput input;             ///< of the first repetition; all others were equal
  std::vector<eval::FrameTiming> timings;  ///< of all repetitions
  std::size_t unpaired_images = 0;
};

/// Reads the recording and runs the odometry over it. `progress(done, all)` is told after each frame.
/// Throws InputError, ParameterError or InputError.
EvaluationRun runEvaluation(const EvaluateOptions& options,
                            const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace stereo_nav::tools
