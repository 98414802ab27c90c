#pragma once

#include <nav_msgs/Odometry.h>
#include <std_msgs/Header.h>
#include <tf2_eigen/tf2_eigen.h>

#include <cmath>
#include <string>

#include "stereo_nav/core/trajectory.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::tools {

inline std_msgs::Header headerOf(double time_s, const std::string& frame_id, std::size_t number) {
  std_msgs::Header header;
  header.stamp.fromNSec(static_cast<std::uint64_t>(std::llround(time_s * 1e9)));
  header.frame_id = frame_id;
  header.seq = static_cast<std::uint32_t>(number);
  return header;
}

/// Pose of base_link in `frame_id`; the twist is not given, zero.
inline nav_msgs::Odometry odometryOf(const StampedPose& pose, const std::string& frame_id,
                                     std::size_t number) {
  nav_msgs::Odometry odometry;
  odometry.header = headerOf(pose.time_s, frame_id, number);
  odometry.child_frame_id = ros_io::frames::kBase;
  odometry.pose.pose = tf2::toMsg(pose.T_world_body);
  return odometry;
}

}  // namespace stereo_nav::tools
