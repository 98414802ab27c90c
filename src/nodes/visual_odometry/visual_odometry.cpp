// The visual_odometry node computes odometry from stereo images, disparity and IMU.
#include "nodes/visual_odometry/visual_odometry_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  const stereo_nav::nodes::VisualOdometryNode node(ros::NodeHandle(), ros::NodeHandle("~"),
                                                   ros::this_node::getName());
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "visual_odometry", run);
}
