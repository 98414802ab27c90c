#pragma once

#include <ros/ros.h>

#include <exception>

#include "ros/master_watch.h"

namespace stereo_nav::ros_io {

/// What every node's main() does: `run` works until ROS shuts down and returns the exit status. An exception
/// is said as fatal and gives status 2, a master that has gone gives 3.
inline int runNode(int argc, char** argv, const char* name, int (*run)()) {
  ros::init(argc, argv, name);
  // With the last handle ROS shuts down, and then nobody hears what was wrong.
  const ros::NodeHandle keeps_ros_running;
  try {
    const MasterWatch master;
    const int status = run();
    return master.exitStatus() != 0 ? master.exitStatus() : status;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
}

}  // namespace stereo_nav::ros_io
