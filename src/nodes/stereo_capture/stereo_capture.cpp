// The stereo_capture node reads two webcams and publishes pairs of images.
#include "nodes/stereo_capture/stereo_capture_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  const stereo_nav::nodes::StereoCaptureNode node(ros::NodeHandle(), ros::NodeHandle("~"));
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "stereo_capture", run);
}
