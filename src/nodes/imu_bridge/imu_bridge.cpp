// The imu_bridge node: a serial IMU module in, imu/data and imu_quat out.
#include "nodes/imu_bridge/imu_bridge_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  stereo_nav::nodes::ImuBridgeNode node{ros::NodeHandle(), ros::NodeHandle("~")};
  // A calibration waits in its service for a quarter of a minute; the rest goes on meanwhile.
  ros::AsyncSpinner spinner(3);
  spinner.start();
  node.run();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "imu_bridge", run);
}
