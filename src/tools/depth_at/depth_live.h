#pragma once

#include "tools/depth_at/depth_at_options.h"

namespace stereo_nav::tools {

/// depth_at on the topics of a running graph. With a pixel it ends after the wanted number of frames, without
/// one when a key is pressed in its window. Throws InputError when nothing comes.
void measureLive(const DepthAtOptions& options);

}  // namespace stereo_nav::tools
