#pragma once

#include <string>

#include "ros/frame_synchroniser.h"
#include "ros/inbox.h"
#include "stereo_nav/core/parameter_visitor.h"
#include "stereo_nav/estimation/base_odometry.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {

/// Parameters of the visual_odometry node and nodelet, in its private namespace. Those of the odometry itself
/// (config/vo*.yaml) are below `~vo`.
struct VisualOdometryParams {
  enum class Imu { kNone, kImu, kQuaternion };
  enum class InitialAttitude { kIdentity, kGravity };

  std::string odom_frame = ros_io::frames::kOdom;
  std::string base_frame = ros_io::frames::kBase;
  std::string imu_frame;
  bool publish_tf = true;
  Imu imu = Imu::kImu;
  InitialAttitude initial_attitude = InitialAttitude::kIdentity;
  double input_timeout_s = 3.0;
  int path_max_poses = 10000;
  double path_spacing_m = 0.02;
  ros_io::FrameSynchroniserParams synchronisation;
  ros_io::InboxParams waiting;
  estimation::UncertaintyParams uncertainty;
  estimation::FloorParams floor;

  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::nodes
