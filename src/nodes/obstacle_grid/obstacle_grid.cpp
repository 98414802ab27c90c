// The obstacle_grid node shows the obstacles around the robot as a local grid.
#include "nodes/obstacle_grid/obstacle_grid_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  const stereo_nav::nodes::ObstacleGridNode node(ros::NodeHandle(), ros::NodeHandle("~"),
                                                 ros::this_node::getName());
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "obstacle_grid", run);
}
