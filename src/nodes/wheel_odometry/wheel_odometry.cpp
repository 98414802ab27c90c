// The wheel_odometry node computes odometry from the pulses of the wheels and the IMU's yaw.
#include "nodes/wheel_odometry/wheel_odometry_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  if (stereo_nav::ros_io::restsWithout(stereo_nav::rig_sections::kDrive)) return 0;
  const stereo_nav::nodes::WheelOdometryNode node(ros::NodeHandle(), ros::NodeHandle("~"),
                                                  ros::this_node::getName());
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "wheel_odometry", run);
}
