#pragma once

#include <ros/time.h>

#include "ros/frame_synchroniser.h"

namespace stereo_nav::ros_io {

/// Counts seconds only while the ROS clock moves, so that a paused replay does not look like silent topics.
/// It must be read often: an interval longer than `longest_tick_s` between two readings also counts as a
/// pause. Not thread-safe.
class RunningClock {
 public:
  explicit RunningClock(double longest_tick_s)
      : longest_tick_s_(longest_tick_s), last_steady_time_(std::chrono::steady_clock::now()) {}

  double seconds();

 private:
  double longest_tick_s_;
  double seconds_ = 0.0;
  ros::Time last_ros_time_;
  SteadyTime last_steady_time_;
};

}  // namespace stereo_nav::ros_io
