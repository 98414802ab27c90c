#include "nodes/recorder/recorded_topics.h"

#include <algorithm>
#include <sstream>

#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {

namespace topics = ros_io::topics;

std::vector<std::string> recordedTopics(const ros_io::BaseBridgeParams& base,
                                        const ros_io::RangeBridgeParams& ranges,
                                        const std::string& more_topics) {
  std::vector<std::string> names = {
      topics::kScan,          topics::kWheelTicks,  topics::kJointStates, topics::kBattery,
      topics::kCmdVel,        topics::kLeftImage,   topics::kRightImage,  topics::kLeftInfo,
      topics::kRightInfo,     topics::kSync,        topics::kImu,         "imu/data_raw",
      topics::kImuQuaternion, topics::kGroundTruth, "/tf_static",         "/diagnostics"};
  for (const auto& joint : base.joints) {
    names.push_back(topics::kJoint + joint.name);
    if (joint.carries_camera) names.push_back("/tf");
  }
  for (const auto& range : base.ranges) names.push_back(topics::kRange + range.name);
  for (const auto& finder : ranges.finders) names.push_back(topics::kRange + finder.name);
  for (const auto& item : base.switches) names.push_back(topics::kSwitch + item.name);
  for (const auto& actuator : base.actuators) {
    names.push_back(topics::kActuator + actuator.name);
    names.push_back(topics::kActuator + actuator.name + topics::kActuatorState);
  }
  std::istringstream more(more_topics);
  for (std::string name; std::getline(more, name, ',');) {
    if (name != "tf" || std::find(names.begin(), names.end(), "/tf") == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace stereo_nav::nodes
