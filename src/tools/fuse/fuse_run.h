#pragma once

#include <string>
#include <vector>

#include "estimation/ekf/fusion_filter.h"
#include "stereo_nav/eval/evaluation.h"
#include "tools/fuse/fusion_input.h"

namespace stereo_nav::tools {

/// What a run of the filter over a recording gave.
struct FuseRun {
  eval::EvaluationInput input;
  std::vector<eval::FrameTiming> timings;  ///< of each measurement
  std::vector<estimation::Channel> channels;
  std::vector<estimation::ChannelStatistics> statistics;
  std::vector<std::string> announcements;  ///< with the time since the first measurement
  std::size_t measurements = 0;
};

/// Runs the filter over the recording, which gives a pose `frequency` times a second. Throws InputError,
/// ParameterError.
FuseRun runFusion(const FuseOptions& options);

}  // namespace stereo_nav::tools
