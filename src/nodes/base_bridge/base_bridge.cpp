// The base_bridge node drives the microcontroller of a base and publishes what it measures.
#include "nodes/base_bridge/base_bridge_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  if (stereo_nav::ros_io::restsWithout(stereo_nav::rig_sections::kBase)) return 0;
  stereo_nav::nodes::BaseBridgeNode node{ros::NodeHandle(), ros::NodeHandle("~")};
  // The services wait for the controller; velocities are received meanwhile.
  ros::AsyncSpinner spinner(3);
  spinner.start();
  node.run();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "base_bridge", run);
}
