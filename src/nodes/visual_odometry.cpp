// The visual_odometry node: stereo images, disparity and IMU in, odometry out.
#include <ros/ros.h>

#include "stereo_nav/nodes/master_watch.h"
#include "stereo_nav/nodes/visual_odometry_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "visual_odometry");
  try {
    const stereo_nav::nodes::VisualOdometryNode node(ros::NodeHandle(), ros::NodeHandle("~"),
                                                     ros::this_node::getName());
    const stereo_nav::nodes::MasterWatch master;
    ros::spin();
    return master.exitStatus();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
}
