#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>

#include <cmath>
#include <string>
#include <vector>

#include "stereo_nav/VoStatus.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {

constexpr double kDegree = M_PI / 180.0;

/// Listens to what the odometry publishes and says, in the thread of the test.
class GraphProbe {
 public:
  GraphProbe();

  /// Whether a log message holds `part` within the time.
  bool waitForLog(const std::string& part, double timeout_s = kLongWait_s);
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
