#pragma once

#include <nav_msgs/Odometry.h>
#include <tf2_ros/transform_broadcaster.h>

namespace stereo_nav::ros_io {

/// Publishes the pose of an odometry message as tf: `header.frame_id` -> `child_frame_id` (odom ->
/// base_link).
class OdomTransformPublisher {
 public:
  void publish(const nav_msgs::Odometry& odometry);

 private:
  tf2_ros::TransformBroadcaster broadcaster_;
};

}  // namespace stereo_nav::ros_io
