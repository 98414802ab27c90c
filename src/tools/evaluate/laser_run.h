#pragma once

#include "tools/evaluate/evaluate_run.h"

namespace stereo_nav::tools {

/// Reads the laser, the wheels and the IMU of a recording and runs the laser odometry over it; a frame is a
/// scan. Throws InputError or ParameterError.
EvaluationRun runLaserEvaluation(const EvaluateOptions& options);

}  // namespace stereo_nav::tools
