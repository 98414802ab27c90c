#pragma once

#include <iosfwd>

#include "sensors/camera/device_finder.h"

namespace stereo_nav::tools {

/// Writes what is connected, in words to choose from: each camera's stable name, formats and, if wanted,
/// controls; which ones share a USB controller; the arguments for capture.launch.
void listCameras(camera::Kernel& kernel, const camera::DeviceFinder& finder, bool with_controls,
                 std::ostream& out);

}  // namespace stereo_nav::tools
