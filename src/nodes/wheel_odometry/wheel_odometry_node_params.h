#pragma once

#include <string>

#include "odometry/wheel/wheel_odometry_params.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {

/// Parameters of the wheel_odometry node: its own, and those of the odometry (config/wheel.yaml, section
/// `wheel_odometry` of the rig file). The wheels are the section `drive` of the rig file.
struct WheelOdometryNodeParams {
  std::string odom_frame = ros_io::frames::kOdom;
  std::string base_frame = ros_io::frames::kBase;
  bool publish_tf = false;
  bool imu = true;
  double imu_wait_s = 0.05;
  double input_timeout_s = 3.0;
  odometry::WheelOdometryParams odometry;

  void describe(ParameterVisitor& visitor) {
    visitor.text("odom_frame", odom_frame, "frame that poses are published in");
    visitor.text("base_frame", base_frame, "frame of the robot whose pose is published");
    visitor.flag("publish_tf", publish_tf,
                 "publish odom_frame -> base_frame in tf; off where another odometry or a filter does");
    visitor.flag("imu", imu, "take the yaw from imu/data where it is published");
    visitor.real("imu_wait_s", imu_wait_s, {0.0, 1.0}, "s",
                 "a reading waits this long for the IMU's sample after it");
    visitor.real("input_timeout_s", input_timeout_s, {0.1, 60.0}, "s",
                 "silence of wheel_ticks before the node explains it");
    odometry.describe(visitor);
  }
};

}  // namespace stereo_nav::nodes
