#include "tools/evaluate/truth_of_base.h"

#include <filesystem>

#include "stereo_nav/ros/topics.h"

namespace stereo_nav::tools {

ros_io::BasePoses truthOfBase(const EvaluateOptions& options, const ros_io::RecordedRobot& robot) {
  if (!options.ground_truth || !std::filesystem::exists(*options.ground_truth)) {
    return robot.poses(options.ground_truth.value_or(ros_io::topics::kGroundTruth),
                       options.ground_truth.has_value(), options.ground_truth_frame);
  }
  const Trajectory truth = readTum(*options.ground_truth);
  const std::string frame = options.ground_truth_frame.value_or(ros_io::frames::kBase);
  return {frame == ros_io::frames::kBase ? truth : ofOtherBody(truth, robot.T_base(frame).inverse()), ""};
}

}  // namespace stereo_nav::tools
