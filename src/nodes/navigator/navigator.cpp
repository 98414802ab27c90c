// The navigator node drives the robot to goals and along paths.
#include "nodes/navigator/navigator_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  const stereo_nav::nodes::NavigatorNode node(ros::NodeHandle(), ros::NodeHandle("~"),
                                              ros::this_node::getName());
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "navigator", run);
}
