#include "ros/recorded_transforms.h"

#include <geometry_msgs/TransformStamped.h>
#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include <functional>
#include <map>
#include <set>

#include "ros/setup_checks.h"
#include "stereo_nav/ros/conversions.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {
namespace {

using geometry_msgs::TransformStamped;

constexpr const char* kAuthority = "recording";

/// Last part of a topic's name.
std::string baseName(const std::string& topic) {
  return topic.substr(topic.find_last_of('/') + 1);
}

void forEachTransform(const rosbag::Bag& bag, const std::string& name,
                      const std::function<void(const TransformStamped&)>& handle) {
  rosbag::View view(bag, rosbag::TypeQuery(std::vector<std::string>{"tf2_msgs/TFMessage", "tf/tfMessage"}));
  for (const rosbag::MessageInstance& message : view) {
    if (baseName(message.getTopic()) != name) continue;
    const auto transforms = message.instantiate<tf2_msgs::TFMessage>();
    if (!transforms) continue;
    for (TransformStamped transform : transforms->transforms) {
      transform.header.frame_id = withoutSlash(transform.header.frame_id);
      transform.child_frame_id = withoutSlash(transform.child_frame_id);
      handle(transform);
    }
  }
}

bool isSame(const TransformStamped& a, const TransformStamped& b) {
  constexpr double kRounding = 1e-6;
  return a.header.frame_id == b.header.frame_id &&
         toIsometry(a.transform).isApprox(toIsometry(b.transform), kRounding);
}

}  // namespace

void readStaticTransforms(const rosbag::Bag& bag, tf2::BufferCore& transforms,
                          std::vector<std::string>& notes) {
  std::set<std::string> given;
  forEachTransform(bag, topics::kTfStatic, [&](const TransformStamped& transform) {
    transforms.setTransform(transform, kAuthority, true);
    given.insert(transform.child_frame_id);
  });
  std::map<std::string, TransformStamped> constant;
  std::set<std::string> moving;
  forEachTransform(bag, topics::kTf, [&](const TransformStamped& transform) {
    if (given.count(transform.child_frame_id) != 0) return;
    const auto first = constant.emplace(transform.child_frame_id, transform).first;
    if (!isSame(first->second, transform)) moving.insert(transform.child_frame_id);
  });
  std::string names;
  for (const auto& [child, transform] : constant) {
    if (moving.count(child) != 0) continue;
    transforms.setTransform(transform, kAuthority, true);
    names += (names.empty() ? "" : ", ") + child;
  }
  if (!names.empty()) {
    notes.push_back(
        "tf_static does not hold the mounting of these frames, it is taken from tf, where it is constant: " +
        names);
  }
}

}  // namespace stereo_nav::ros_io
