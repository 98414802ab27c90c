#include "ros/rig_topics.h"

#include <algorithm>
#include <array>
#include <set>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {
namespace {

constexpr std::array<const char*, 4> kNeeded = {topics::kLeftImage, topics::kRightImage, topics::kLeftInfo,
                                                topics::kRightInfo};

std::string withoutSlashes(const std::string& text) {
  const std::size_t first = text.find_first_not_of('/');
  return first == std::string::npos ? std::string()
                                    : text.substr(first, text.find_last_not_of('/') + 1 - first);
}

/// Compressed images make a rig as plain ones do.
std::string plainTopic(const std::string& topic) {
  const std::string end = topics::kCompressed;
  const bool compressed =
      topic.size() > end.size() && topic.compare(topic.size() - end.size(), end.size(), end) == 0;
  return compressed ? topic.substr(0, topic.size() - end.size()) : topic;
}

/// "/a (lacks camera/left/camera_info), /b"
std::string describe(const std::vector<std::string>& rigs, const std::vector<std::string>& all_topics) {
  std::set<std::string> names;
  for (const std::string& topic : all_topics) names.insert(withoutSlashes(topic));
  std::string text;
  for (const std::string& rig : rigs) {
    std::string lacking;
    for (const char* needed : kNeeded) {
      const std::string name = (rig.empty() ? "" : rig + "/") + needed;
      if (names.count(name) == 0 && names.count(name + topics::kCompressed) == 0)
        lacking += (lacking.empty() ? " (lacks " : ", ") + std::string(needed);
    }
    text += (text.empty() ? "/" : ", /") + rig + (lacking.empty() ? "" : lacking + ")");
  }
  return text.empty() ? "none" : text;
}

}  // namespace

std::vector<std::string> rigNamespaces(const std::vector<std::string>& topics) {
  std::set<std::string> rigs;
  for (const std::string& topic : topics) {
    const std::string name = "/" + withoutSlashes(plainTopic(topic));
    for (const char* needed : kNeeded) {
      const std::string end = std::string("/") + needed;
      if (name.size() < end.size() || name.compare(name.size() - end.size(), end.size(), end) != 0) continue;
      rigs.insert(withoutSlashes(name.substr(0, name.size() - end.size())));
    }
  }
  return {rigs.begin(), rigs.end()};
}

std::string chooseRig(const std::vector<std::string>& topics, const std::optional<std::string>& wanted) {
  const auto rigs = rigNamespaces(topics);
  if (wanted) {
    std::string name = withoutSlashes(*wanted);
    if (std::find(rigs.begin(), rigs.end(), name) != rigs.end()) return name;
    throw InputError("no stereo rig in the namespace '/" + name + "'; the rigs are " +
                     describe(rigs, topics));
  }
  if (rigs.size() > 1) {
    throw InputError("holds several stereo rigs: " + describe(rigs, topics) +
                     "; choose one of them by --namespace");
  }
  return rigs.empty() ? std::string() : rigs.front();
}

}  // namespace stereo_nav::ros_io
