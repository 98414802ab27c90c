#pragma once

#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <array>
#include <string>

#include "ros/info_gate.h"

namespace stereo_nav::ros_io {

/// The InfoGate between `camera/{left,right}/camera_info` and `camera/{left,right}/checked_info`, which the
/// image nodelets subscribe in its place. A refused pair is said once, and again every minute, while anybody
/// waits for it. Raw images are only subscribed while the gate wants them.
class CameraInfoGate {
 public:
  /// `name` begins the log messages. The callbacks of `handle` must come from one thread.
  CameraInfoGate(const ros::NodeHandle& handle, std::string name);

 private:
  void handleInfo(InfoGate::Side side, const sensor_msgs::CameraInfoConstPtr& info);
  void handleImage(InfoGate::Side side, const sensor_msgs::ImageConstPtr& image);
  void askForImages();
  void publish(const std::vector<InfoGate::Passed>& passed);
  bool anybodyWaits() const;
  void report();

  ros::NodeHandle handle_;
  std::string name_;
  InfoGate gate_;
  std::string problem_said_;
  std::vector<std::string> notes_said_;
  ros::WallTime said_at_;
  std::array<ros::Publisher, 2> publishers_;
  std::array<ros::Subscriber, 2> images_;
  std::array<ros::Subscriber, 2> infos_;
  ros::WallTimer overdue_;  ///< runs while images are wanted
};

}  // namespace stereo_nav::ros_io
