// The range_bridge node reads TFmini range finders and publishes range/NAME.
#include "nodes/range_bridge/range_bridge_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  if (stereo_nav::ros_io::restsWithout(stereo_nav::rig_sections::kRangeFinders)) return 0;
  const stereo_nav::nodes::RangeBridgeNode node{ros::NodeHandle(), ros::NodeHandle("~")};
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "range_bridge", run);
}
