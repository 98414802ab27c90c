#pragma once

#include <ros/ros.h>

#include <exception>

#include "ros/master_watch.h"

namespace stereo_nav::ros_io {

/// The main() of every node. `run` works until ROS shuts down and returns the exit status. An exception is
/// logged as fatal and gives status 2; the loss of the master gives status 3.
inline int runNode(int argc, char** argv, const char* name, int (*run)()) {
  ros::init(argc, argv, name);
  // ROS shuts down with the last handle, and after that the error could not be logged.
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
