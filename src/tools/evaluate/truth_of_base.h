#pragma once

#include "ros/recorded_robot.h"
#include "tools/evaluate/evaluate_options.h"

namespace stereo_nav::tools {

/// Poses of base_link from the file or the topic that the options name, or from the bag's ground truth.
ros_io::BasePoses truthOfBase(const EvaluateOptions& options, const ros_io::RecordedRobot& robot);

}  // namespace stereo_nav::tools
