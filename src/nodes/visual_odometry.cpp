// The visual_odometry node: stereo images, disparity and IMU in, odometry out.
#include "stereo_nav/nodes/node_program.h"
#include "stereo_nav/nodes/visual_odometry_node.h"

namespace {

int run() {
  const stereo_nav::nodes::VisualOdometryNode node(ros::NodeHandle(), ros::NodeHandle("~"),
                                                   ros::this_node::getName());
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::nodes::runNode(argc, argv, "visual_odometry", run);
}
