// The imu_bridge node reads a serial IMU module and publishes imu/data and imu_quat.
#include "nodes/imu_bridge/imu_bridge_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  stereo_nav::nodes::ImuBridgeNode node{ros::NodeHandle(), ros::NodeHandle("~")};
  // The service that calibrates takes a quarter of a minute; other callbacks are served meanwhile.
  ros::AsyncSpinner spinner(3);
  spinner.start();
  node.run();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "imu_bridge", run);
}
