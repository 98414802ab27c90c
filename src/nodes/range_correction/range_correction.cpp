// The range_correction node corrects the robot's place in a map by range finders against its walls.
#include "nodes/range_correction/range_correction_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  const stereo_nav::nodes::RangeCorrectionNode node(ros::NodeHandle(), ros::NodeHandle("~"),
                                                    ros::this_node::getName());
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "range_correction", run);
}
