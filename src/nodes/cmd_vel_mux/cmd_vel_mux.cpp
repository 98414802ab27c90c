// The cmd_vel_mux node passes on the velocity of the sender of highest rank.
#include "nodes/cmd_vel_mux/cmd_vel_mux_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  if (stereo_nav::ros_io::restsWithout(stereo_nav::rig_sections::kBase)) return 0;
  const stereo_nav::nodes::CmdVelMuxNode node(ros::NodeHandle(), ros::NodeHandle("~"));
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "cmd_vel_mux", run);
}
