// The laser_odometry node computes odometry from the scans of a planar laser, with wheels and gyroscope.
#include "nodes/laser_odometry/laser_odometry_node.h"
#include "ros/node_program.h"

namespace {

int run() {
  if (stereo_nav::ros_io::restsWithout(stereo_nav::rig_sections::kLaser)) return 0;
  const stereo_nav::nodes::LaserOdometryNode node(ros::NodeHandle(), ros::NodeHandle("~"),
                                                  ros::this_node::getName());
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "laser_odometry", run);
}
