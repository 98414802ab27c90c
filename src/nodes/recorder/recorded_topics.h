#pragma once

#include <string>
#include <vector>

#include "ros/base_bridge_params.h"
#include "ros/range_bridge_params.h"

namespace stereo_nav::nodes {

/// Relative names of what the recorder writes: all that the odometries need to run on the recording later,
/// what was commanded, and the robot's diagnostics. The rig file names servos, range finders, switches and
/// actuators; `more_topics`, separated by commas, come last.
std::vector<std::string> recordedTopics(const ros_io::BaseBridgeParams& base,
                                        const ros_io::RangeBridgeParams& ranges,
                                        const std::string& more_topics);

}  // namespace stereo_nav::nodes
