#pragma once

#include <string>

#include "stereo_nav/Keyframe.h"
#include "vision/keyframe.h"

namespace stereo_nav::ros_io {

/// `frame_id`: the left optical frame. Pixels are rounded to single precision.
Keyframe toMessage(const vision::Keyframe& keyframe, const std::string& frame_id);

/// Throws InputError for lists of different lengths, descriptors that are not of all corners, and numbers
/// that cannot be: it says which.
vision::Keyframe toKeyframe(const Keyframe& message);

}  // namespace stereo_nav::ros_io
