#pragma once

#include <ros/time.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace stereo_nav::ros_io {

/// Watches the topics of a node and explains, after a few seconds, why nothing comes out of it: which topic
/// is silent or which stamps do not fit, the likely cause and the remedy. Times are seconds on a clock that
/// only runs forward and stands still while a replay is paused.
class InputMonitor {
 public:
  struct Input {
    std::string topic;                         ///< resolved name
    std::string remedy;                        ///< what to look at if it is silent
    bool stamped = true;                       ///< its stamps take part in the synchronisation
    std::function<unsigned int()> publishers;  ///< how many nodes publish it now
  };

  InputMonitor(double timeout_s, double now_s)
      : timeout_s_(timeout_s), last_frame_s_(now_s), start_s_(now_s) {}

  std::size_t add(Input input);
  void setTimeout(double timeout_s) { timeout_s_ = timeout_s; }
  void received(std::size_t input, const ros::Time& stamp, double now_s);
  void frameCompleted(double now_s) { last_frame_s_ = now_s; }

  /// One text for each silent input, by topic; empty texts for those that are not.
  std::map<std::string, std::string> silentInputs(double now_s) const;

  /// All inputs run and yet no frame comes together; empty if that is not so.
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
