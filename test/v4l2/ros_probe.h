#pragma once

#include <ros/ros.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "sensors/camera/clock_mapping.h"
#include "sensors/camera/kernel.h"

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

/// Handles messages until the condition is true; false after a generous time, since on a busy host the
/// machine takes a minute to load a node's libraries.
inline bool comesTrue(const std::function<bool()>& condition,
                      std::chrono::seconds patience = std::chrono::seconds(300)) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    ros::spinOnce();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
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
