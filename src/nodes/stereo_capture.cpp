#include <ros/ros.h>

#include "stereo_nav/nodes/master_watch.h"
#include "stereo_nav/nodes/stereo_capture_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "stereo_capture");
  const ros::NodeHandle handle;
  const ros::NodeHandle private_handle("~");
  try {
    const stereo_nav::nodes::StereoCaptureNode node(handle, private_handle);
    const stereo_nav::nodes::MasterWatch master;
    ros::spin();
    return master.exitStatus();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
}
