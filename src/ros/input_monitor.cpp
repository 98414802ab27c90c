#include "ros/input_monitor.h"

#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

namespace stereo_nav::ros_io {

std::size_t InputMonitor::add(Input input) {
  states_.push_back({std::move(input), 0, ros::Time(), start_s_});
  return states_.size() - 1;
}

void InputMonitor::received(std::size_t input, const ros::Time& stamp, double now_s) {
  State& state = states_[input];
  ++state.count;
  state.last_stamp = stamp;
  state.last_s = now_s;
}

bool InputMonitor::isSilent(const State& state, double now_s) const {
  return now_s - state.last_s > timeout_s_;
}

std::map<std::string, std::string> InputMonitor::silentInputs(double now_s) const {
  std::map<std::string, std::string> texts;
  for (const State& state : states_) {
    std::string& text = texts[state.input.topic];
    if (!isSilent(state, now_s)) continue;
    std::ostringstream message;
    message << "no message on " << state.input.topic << " for " << std::fixed << std::setprecision(0)
            << now_s - state.last_s << " s";
    if (state.count > 0) {
      message << " (" << state.count << " before, last stamp " << std::setprecision(3)
              << state.last_stamp.toSec() << ")";
    }
    const unsigned int publishers = state.input.publishers();
    if (publishers == 0) {
      message
          << "; no node publishes it: not started, stopped, or under another name (compare `rostopic list`, "
             "remap)";
    } else {
      message << "; " << publishers << " connected publisher(s) send nothing: they wait for their own input";
    }
    message << ". " << state.input.remedy;
    text = message.str();
  }
  return texts;
}

std::string InputMonitor::unsynchronised(double now_s) const {
  if (states_.empty() || now_s - last_frame_s_ <= timeout_s_) return "";
  for (const State& state : states_) {
    if (isSilent(state, now_s)) return "";
  }
  std::ostringstream message;
  message << std::fixed << "all topics run, but for " << std::setprecision(0) << now_s - last_frame_s_
          << " s no stereo frame came together. Last stamps:";
  message << std::setprecision(3);
  const State* reference = nullptr;
  double widest_s = 0.0;
  for (const State& state : states_) {
    if (!state.input.stamped) continue;
    if (reference == nullptr) reference = &state;
    const double offset_s = (state.last_stamp - reference->last_stamp).toSec();
    if (std::abs(offset_s) > std::abs(widest_s)) widest_s = offset_s;
    message << " " << state.input.topic << " " << state.last_stamp.toSec() << " (" << std::showpos << offset_s
            << std::noshowpos << " s)";
  }
  constexpr double kOtherClock_s = 1.0;
  if (std::abs(widest_s) > kOtherClock_s) {
    message
        << ". Stamps this far apart come from different clocks or recordings: run all drivers on one host's "
           "clock (chrony between hosts), and do not mix a bag with live topics";
  } else {
    message
        << ". The disparity must carry the left image's exact stamp (disparity nodelet without "
           "approximate_sync) and a right image must lie within synchronisation/max_time_offset_s of it: use "
           "stereo_capture, which stamps a pair alike, or raise max_time_offset_s for free-running cameras";
  }
  return message.str();
}

}  // namespace stereo_nav::ros_io
