#pragma once

#include <ros/time.h>

#include "sensors/serial/steady_clock.h"

namespace stereo_nav::ros_io {

/// ROS stamps of times on the steady clock, which clock synchronisation does not set. The offset between the
/// two is measured for each stamp; stamps grow, except where the clock of ROS was set back.
class SteadyStamps {
 public:
  ros::Time at(double steady_s) {
    ros::Time stamp = ros::Time::now() - ros::Duration(serial::steadyNow_s() - steady_s);
    const ros::Duration one_microsecond(0, 1000);
    const bool clock_was_set_back = last_ - stamp > ros::Duration(1.0);
    if (stamp <= last_ && !clock_was_set_back) stamp = last_ + one_microsecond;
    last_ = stamp;
    return stamp;
  }

 private:
  ros::Time last_;
};

}  // namespace stereo_nav::ros_io
