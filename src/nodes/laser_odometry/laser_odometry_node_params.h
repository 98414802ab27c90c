#pragma once

#include <string>

#include "odometry/laser/laser_params.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {

/// Parameters of the laser_odometry node: its own, and those of the odometry (config/laser_odometry.yaml).
struct LaserOdometryNodeParams {
  std::string odom_frame = ros_io::frames::kOdom;
  std::string base_frame = ros_io::frames::kBase;
  bool publish_tf = false;
  bool wheels = true;
  bool imu = true;
  double prior_wait_s = 0.3;
  double input_timeout_s = 3.0;
  odometry::LaserParams odometry;

  void describe(ParameterVisitor& visitor) {
    visitor.text("odom_frame", odom_frame, "frame that poses are published in");
    visitor.text("base_frame", base_frame, "frame of the robot whose pose is published");
    visitor.flag("publish_tf", publish_tf,
                 "publish odom_frame -> base_frame in tf; off where another odometry or a filter does");
    visitor.flag("wheels", wheels, "take the prior from wheel/odom where it is published");
    visitor.flag("imu", imu, "take the turn from the gyroscope of imu/data where it is published");
    visitor.real("prior_wait_s", prior_wait_s, {0.0, 2.0}, "s",
                 "a scan waits this long, at most, for the wheels and the IMU to cover it");
    visitor.real("input_timeout_s", input_timeout_s, {0.1, 60.0}, "s",
                 "silence of scan before the node explains it");
    odometry.describe(visitor);
  }
};

}  // namespace stereo_nav::nodes
