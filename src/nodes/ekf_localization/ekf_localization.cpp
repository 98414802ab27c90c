// The ekf_localization node: one pose from everything that the robot measures.
#include "nodes/ekf_localization/ekf_localization_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  const stereo_nav::nodes::EkfLocalizationNode node(ros::NodeHandle(), ros::NodeHandle("~"),
                                                    ros::this_node::getName());
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "ekf_localization", run);
}
