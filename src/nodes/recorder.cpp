// Records the sensors into bags and watches the disk.
#include <ros/ros.h>

#include "stereo_nav/nodes/master_watch.h"
#include "stereo_nav/nodes/recorder_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "recorder");
  try {
    stereo_nav::nodes::RecorderNode node{ros::NodeHandle(), ros::NodeHandle("~")};
    const stereo_nav::nodes::MasterWatch master;
    const int status = node.run();
    return master.exitStatus() != 0 ? master.exitStatus() : status;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
}
