#include <ros/ros.h>

#include "stereo_nav/nodes/stereo_capture_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "stereo_capture");
  const ros::NodeHandle handle;
  const ros::NodeHandle private_handle("~");
  try {
    const stereo_nav::nodes::StereoCaptureNode node(handle, private_handle);
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
  return 0;
}
