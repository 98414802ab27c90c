#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <string>

#include "core/rig_file.h"
#include "ros/master_watch.h"

namespace stereo_nav::ros_io {

inline bool asksForHelp(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc,
                     [](const std::string& argument) { return argument == "-h" || argument == "--help"; });
}

/// robot.launch starts a node whatever the rig file holds, with `~if_in_rig`: where its section is missing
/// the node says so, in diagnostics as well, and rests. Returns whether it did, up to the end.
inline bool restsWithout(const char* section) {
  const ros::NodeHandle private_handle("~");
  if (!private_handle.param("if_in_rig", false)) return false;
  if (!RigFile::load(private_handle.param<std::string>("rig", "")).section(section).IsNull()) return false;
  const std::string text = "the rig file has no section `" + std::string(section) + "`: nothing to do";
  ROS_INFO_STREAM(text);
  diagnostic_updater::Updater updater;
  updater.setHardwareID("none");
  updater.add("rests", [&text](diagnostic_updater::DiagnosticStatusWrapper& status) {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK, text);
  });
  const ros::WallTimer timer = ros::NodeHandle().createWallTimer(
      ros::WallDuration(1.0), [&updater](const ros::WallTimerEvent&) { updater.update(); });
  ros::spin();
  return true;
}

/// The main() of every node. `run` works until ROS shuts down and returns the exit status. An exception is
/// logged as fatal and gives status 2; the loss of the master gives status 3.
inline int runNode(int argc, char** argv, const char* name, int (*run)()) {
  if (asksForHelp(argc, argv)) {
    std::cout << "usage: rosrun stereo_nav " << name << " [TOPIC:=OTHER] [_PARAMETER:=VALUE]\n"
              << "A ROS node; the README says where its topics are described, docs/parameters.md lists its "
                 "parameters.\n";
    return 0;
  }
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
