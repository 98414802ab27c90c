// The map_image_server node publishes a map image of map_server's format.
#include "nodes/map_image_server/map_image_server_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  const stereo_nav::nodes::MapImageServerNode node(ros::NodeHandle(), ros::NodeHandle("~"));
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "map_image_server", run);
}
