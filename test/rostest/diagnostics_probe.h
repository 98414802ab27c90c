#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>

#include <map>
#include <string>

namespace stereo_nav::test {

/// The newest of each state in /diagnostics or a topic like it, by its full name, e.g. "imu_bridge: imu".
class DiagnosticsProbe {
 public:
  explicit DiagnosticsProbe(const std::string& topic = "/diagnostics") {
    subscriber_ = handle_.subscribe(topic, 100, &DiagnosticsProbe::add, this);
  }

  bool has(const std::string& name) const { return states_.count(name) != 0; }
  /// Level, message and values; empty while there is none.
  std::string textOf(const std::string& name) const {
    const auto found = states_.find(name);
    if (found == states_.end()) return {};
    std::string text = found->second.message;
    for (const auto& value : found->second.values) text += "\n" + value.key + ": " + value.value;
    return text;
  }
  bool says(const std::string& name, const std::string& text) const {
    return textOf(name).find(text) != std::string::npos;
  }
  /// 0 good, 1 warning, 2 error, 3 stale; -1 while there is none.
  int levelOf(const std::string& name) const {
    const auto found = states_.find(name);
    return found == states_.end() ? -1 : found->second.level;
  }
  /// All names, for messages.
  std::string names() const {
    std::string text;
    for (const auto& state : states_) text += state.first + "\n";
    return text;
  }

 private:
  void add(const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
    for (const auto& state : message->status) states_[state.name] = state;
  }

  ros::NodeHandle handle_;
  ros::Subscriber subscriber_;
  std::map<std::string, diagnostic_msgs::DiagnosticStatus> states_;
};

}  // namespace stereo_nav::test
