#pragma once

#include <ros/ros.h>

#include "support/wait.h"

namespace stereo_nav::test {

/// Handles messages until `condition` holds; false when it still does not after `timeout_s` of wall time, or
/// when the node is told to end.
template <class Condition>
bool spinUntil(Condition&& condition, double timeout_s = kLongWait_s, double poll_s = 0.005) {
  const auto holdsOrEnds = [&condition] {
    if (!ros::ok() || condition()) return true;
    ros::spinOnce();
    return false;
  };
  return waitUntil(holdsOrEnds, timeout_s, poll_s) && ros::ok();
}

}  // namespace stereo_nav::test
