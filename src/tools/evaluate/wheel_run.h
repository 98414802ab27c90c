#pragma once

#include "tools/evaluate/evaluate_run.h"

namespace stereo_nav::tools {

/// Reads the wheels of a recording and runs their odometry over it; a frame is a reading of the counters.
/// Throws InputError or ParameterError.
EvaluationRun runWheelEvaluation(const EvaluateOptions& options);

}  // namespace stereo_nav::tools
