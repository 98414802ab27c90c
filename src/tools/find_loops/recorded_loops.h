#pragma once

#include <cstddef>
#include <functional>

#include "tools/find_loops/find_loops_options.h"
#include "tools/find_loops/loop_run.h"

namespace stereo_nav::tools {

/// Runs the odometry over a recording, makes keyframes and finds loops among them. `progress(done, all)` is
/// told after each frame. Throws InputError, ParameterError.
LoopRun findLoopsInRecording(const FindLoopsOptions& options,
                             const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace stereo_nav::tools
