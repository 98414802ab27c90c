#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <string>

#include "nodes/laser_odometry/laser_session.h"
#include "ros/problem_list.h"

namespace stereo_nav::nodes {

/// The health of the laser odometry: logs problems when they begin, while they last and when they end, and
/// reports them with the state of the last scan on /diagnostics. Not thread-safe.
class LaserHealth {
 public:
  LaserHealth(ros::NodeHandle& handle, ros::NodeHandle& private_handle, const std::string& name);

  /// Sets the problem `key`; an empty text ends it.
  void set(const std::string& key, bool is_error, const std::string& text);
  void scanDone(const LaserReading& reading) { last_ = reading; }
  void publish(const ScanCounts& counts);

 private:
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::string name_;
  ros_io::ProblemList problems_;
  diagnostic_updater::Updater updater_;
  std::optional<LaserReading> last_;
  ScanCounts counts_;
};

}  // namespace stereo_nav::nodes
