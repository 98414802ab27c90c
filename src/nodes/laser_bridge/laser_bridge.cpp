// The laser_bridge node reads an RPLiDAR A1 and publishes scan.
#include "nodes/laser_bridge/laser_bridge_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  if (stereo_nav::ros_io::restsWithout(stereo_nav::rig_sections::kLaser)) return 0;
  stereo_nav::nodes::LaserBridgeNode node{ros::NodeHandle(), ros::NodeHandle("~")};
  // Diagnostics run while the scanner is waited for.
  ros::AsyncSpinner spinner(1);
  spinner.start();
  node.run();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "laser_bridge", run);
}
