#pragma once

#include "tools/find_loops/find_loops_options.h"
#include "tools/find_loops/loop_run.h"

namespace stereo_nav::tools {

/// Finds loops among the images of a folder, taken by one camera in the order of their names, in which
/// numbers count as such. Throws InputError where there is none, or one cannot be read.
LoopRun findLoopsInFolder(const FindLoopsOptions& options);

}  // namespace stereo_nav::tools
