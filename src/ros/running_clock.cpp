#include "ros/running_clock.h"

#include <algorithm>

namespace stereo_nav::ros_io {

double RunningClock::seconds() {
  if (ros::Time::isSimTime()) {
    const ros::Time ros_now = ros::Time::now();
    if (ros_now == last_ros_time_) return seconds_;
    last_ros_time_ = ros_now;
  }
  const auto steady_now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> elapsed = steady_now - last_steady_time_;
  seconds_ += std::min(elapsed.count(), longest_tick_s_);
  last_steady_time_ = steady_now;
  return seconds_;
}

}  // namespace stereo_nav::ros_io
