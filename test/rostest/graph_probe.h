#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>

#include <functional>
#include <string>
#include <vector>

#include "stereo_nav/VoStatus.h"

namespace stereo_nav::test {

/// Listens to what the odometry publishes and says, in the thread of the test.
class GraphProbe {
 public:
  GraphProbe();

  /// Handles messages until `condition` holds; false when `timeout_s` of wall time have passed before.
  bool waitUntil(const std::function<bool()>& condition, double timeout_s);
  /// Whether a log message holds `part` within the time.
  bool waitForLog(const std::string& part, double timeout_s);
  void forget();

  std::vector<nav_msgs::Odometry> odometry;
  std::vector<VoStatus> status;
  std::vector<nav_msgs::Odometry> ground_truth;
  std::vector<std::string> log;

 private:
  ros::NodeHandle handle_;
  std::vector<ros::Subscriber> subscribers_;
};

/// Distance in m between two poses' positions.
double distance(const nav_msgs::Odometry& a, const nav_msgs::Odometry& b);

}  // namespace stereo_nav::test
