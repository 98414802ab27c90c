// The stereo_capture node: two webcams in, pairs of images out.
#include "stereo_nav/nodes/node_program.h"
#include "stereo_nav/nodes/stereo_capture_node.h"

namespace {

int run() {
  const stereo_nav::nodes::StereoCaptureNode node(ros::NodeHandle(), ros::NodeHandle("~"));
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::nodes::runNode(argc, argv, "stereo_capture", run);
}
