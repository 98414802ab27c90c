// Records the sensors into bags and watches the disk.
#include "stereo_nav/nodes/node_program.h"
#include "stereo_nav/nodes/recorder_node.h"

namespace {

int run() {
  return stereo_nav::nodes::RecorderNode(ros::NodeHandle(), ros::NodeHandle("~")).run();
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::nodes::runNode(argc, argv, "recorder", run);
}
