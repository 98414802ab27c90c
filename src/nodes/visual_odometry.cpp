// The visual_odometry node: stereo images, disparity and IMU in, odometry out.
#include <ros/ros.h>

#include "stereo_nav/nodes/visual_odometry_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "visual_odometry");
  try {
    const stereo_nav::nodes::VisualOdometryNode node(ros::NodeHandle(), ros::NodeHandle("~"),
                                                     ros::this_node::getName());
    ros::spin();
    return 0;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
}
