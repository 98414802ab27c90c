#pragma once

#include "tools/evaluate/evaluate_run.h"

namespace stereo_nav::tools {

/// Runs EKF-SLAM over the images of one camera of a recording, with the turns of its IMU and the speed of its
/// wheels where these are recorded. Without wheels the scale is unknown: it is then fitted to the ground
/// truth, which a note says, so that the errors are those after similarity. Throws InputError or
/// ParameterError.
EvaluationRun runMonoEvaluation(const EvaluateOptions& options,
                                const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace stereo_nav::tools
