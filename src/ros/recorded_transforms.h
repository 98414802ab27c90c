#pragma once

#include <rosbag/bag.h>
#include <tf2/buffer_core.h>

#include <string>
#include <vector>

namespace stereo_nav::ros_io {

/// Adds the static transforms of a recording: those of `tf_static` and, for frames that it does not give,
/// those of `tf` that are the same in all messages, which a note names.
void readStaticTransforms(const rosbag::Bag& bag, tf2::BufferCore& transforms,
                          std::vector<std::string>& notes);

}  // namespace stereo_nav::ros_io
