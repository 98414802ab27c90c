// Records the sensors into bags and watches the disk.
#include "nodes/recorder/recorder_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  return stereo_nav::nodes::RecorderNode(ros::NodeHandle(), ros::NodeHandle("~")).run();
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "recorder", run);
}
