#pragma once

#include <iosfwd>

#include "stereo_nav/capture/device_finder.h"

namespace stereo_nav::tools {

/// Writes what is connected, in words to choose from: each camera's stable name, formats and, if wanted,
/// controls; which ones share a USB controller; the arguments for capture.launch.
void listCameras(capture::Kernel& kernel, const capture::DeviceFinder& finder, bool with_controls,
                 std::ostream& out);

}  // namespace stereo_nav::tools
