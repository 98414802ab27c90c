#pragma once

#include <geometry_msgs/PoseWithCovariance.h>
#include <image_transport/image_transport.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>

#include <cstdint>
#include <string>

#include "nodes/visual_odometry/odometry_session.h"
#include "odometry/method/keyframe_maker.h"
#include "ros/odom_transform_publisher.h"
#include "stereo_nav/VoStatus.h"

namespace stereo_nav::nodes {

/// Counts of the whole run, for vo/status.
struct FrameCounts {
  std::uint64_t frames = 0;
  std::uint64_t dropped = 0;
  std::uint64_t lost = 0;
};

/// Publishes the odometry's result of a frame. Images, cloud, keyframes and path are published only if there
/// are subscribers.
class OdometryPublisher {
 public:
  OdometryPublisher(ros::NodeHandle& handle, const VisualOdometryParams& params);

  void publish(const ros_io::FrameMessages& frame, const SessionOutput& output, const FrameCounts& counts);
  void forgetPath() { path_.poses.clear(); }
  /// Applies changes by dynamic_reconfigure.
  void applyLive(const VisualOdometryParams& params) { params_ = params; }

 private:
  void publishOdometry(const ros_io::FrameMessages& frame, const estimation::BaseEstimate& base);
  void publishPath(const std_msgs::Header& header, const geometry_msgs::Pose& pose);
  void publishStatus(const ros_io::FrameMessages& frame, const SessionOutput& output,
                     const FrameCounts& counts);
  void publishKeyframe(const ros_io::FrameMessages& frame, const SessionOutput& output);
  void publishViews(const ros_io::FrameMessages& frame, const SessionOutput& output);

  VisualOdometryParams params_;
  ros::Publisher odometry_publisher_;
  ros::Publisher path_publisher_;
  ros::Publisher status_publisher_;
  ros::Publisher features_publisher_;
  ros::Publisher keyframe_publisher_;
  odometry::KeyframeMaker keyframe_maker_;
  image_transport::ImageTransport image_transport_;
  image_transport::Publisher debug_publisher_;
  ros_io::OdomTransformPublisher transform_publisher_;
  nav_msgs::Path path_;
};

}  // namespace stereo_nav::nodes
