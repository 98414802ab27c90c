#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "sensors/camera/clock_mapping.h"
#include "sensors/camera/kernel.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {

/// All messages of a topic.
template <class Message>
class Topic {
 public:
  explicit Topic(const std::string& name)
      : subscriber_(handle_.subscribe<Message>(
            name, 100,
            [this](const boost::shared_ptr<const Message>& message) { messages.push_back(message); })) {}
  std::vector<boost::shared_ptr<const Message>> messages;

 private:
  ros::NodeHandle handle_;
  ros::Subscriber subscriber_;
};

/// spinUntil() with more patience: on a busy host the machine takes a minute to load a node's libraries.
template <class Condition>
bool comesTrue(Condition&& condition, double patience_s = 300.0, double poll_s = 0.005) {
  return spinUntil(condition, patience_s, poll_s);
}

/// Offset of ROS time from the monotonic clock; a reading that was interrupted does not count.
inline double rosMinusMonotonic_s() {
  const camera::ClockMapping mapping([] { return camera::linuxKernel().monotonicNow(); },
                                     [] { return camera::linuxKernel().realtimeNow(); });
  return 1e-9 * static_cast<double>(mapping.offset_ns());
}

/// Private namespace of the capture node.
inline const std::string kNode = "/stereo_capture";

inline void setCameras(const std::string& left, const std::string& right, int width, int height,
                       double rate_hz) {
  ros::param::del(kNode);
  ros::param::set(kNode + "/left/device", left);
  ros::param::set(kNode + "/right/device", right);
  ros::param::set(kNode + "/width", width);
  ros::param::set(kNode + "/height", height);
  ros::param::set(kNode + "/rate_hz", rate_hz);
  ros::param::set(kNode + "/max_time_offset_s", 0.4 / rate_hz);
  ros::param::set(kNode + "/stall_timeout_s", 10.0);
}

}  // namespace stereo_nav::test
