// The imu_bridge node: a serial IMU module in, imu/data and imu_quat out.
#include <ros/ros.h>

#include "stereo_nav/nodes/imu_bridge_node.h"
#include "stereo_nav/nodes/master_watch.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "imu_bridge");
  try {
    stereo_nav::nodes::ImuBridgeNode node{ros::NodeHandle(), ros::NodeHandle("~")};
    // A calibration waits in its service for a quarter of a minute; the rest goes on meanwhile.
    ros::AsyncSpinner spinner(3);
    spinner.start();
    const stereo_nav::nodes::MasterWatch master;
    node.run();
    return master.exitStatus();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
}
