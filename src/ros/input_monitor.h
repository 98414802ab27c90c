#pragma once

#include <ros/time.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace stereo_nav::ros_io {

/// Watches the input topics of a node. When the node has had no output for a few seconds, it explains which
/// topic is silent or which stamps do not match, the likely cause and the remedy. Times are seconds on a
/// clock that only runs forward and stands still while a replay is paused.
class InputMonitor {
 public:
  struct Input {
    std::string topic;                         ///< resolved name
    std::string remedy;                        ///< what to check if it is silent
    bool stamped = true;                       ///< its stamps take part in the synchronisation
    std::function<unsigned int()> publishers;  ///< how many nodes publish it now
  };

  InputMonitor(double timeout_s, double now_s)
      : timeout_s_(timeout_s), last_frame_s_(now_s), start_s_(now_s) {}

  std::size_t add(Input input);
  void setTimeout(double timeout_s) { timeout_s_ = timeout_s; }
  void received(std::size_t input, const ros::Time& stamp, double now_s);
  void frameCompleted(double now_s) { last_frame_s_ = now_s; }

  /// One text for each input, by topic; empty for inputs that are not silent.
  std::map<std::string, std::string> silentInputs(double now_s) const;

  /// Text for the case that all inputs deliver and yet no frame is completed; otherwise empty.
  std::string unsynchronised(double now_s) const;

 private:
  struct State {
    Input input;
    std::uint64_t count = 0;
    ros::Time last_stamp;
    double last_s = 0.0;
  };

  bool isSilent(const State& state, double now_s) const;

  double timeout_s_;
  double last_frame_s_;
  double start_s_;
  std::vector<State> states_;
};

}  // namespace stereo_nav::ros_io
