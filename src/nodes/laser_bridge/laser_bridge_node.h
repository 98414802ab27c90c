#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include "ros/laser_bridge_params.h"
#include "ros/link_report.h"
#include "ros/steady_stamps.h"
#include "sensors/laser/laser_device.h"

namespace stereo_nav::nodes {

/// A laser scanner on the topic scan. run() reads it in the calling thread; diagnostics run in another one.
class LaserBridgeNode {
 public:
  /// Throws ParameterError.
  LaserBridgeNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  /// Works until ROS shuts down.
  void run();

 private:
  void publish(const laser::Scan& scan);
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);
  void watch(const ros::WallTimerEvent& event);

  ros::NodeHandle handle_, private_handle_;
  const ros_io::LaserBridgeParams params_;
  laser::LaserDevice device_;
  ros::Publisher scan_;
  ros_io::SteadyStamps stamps_;
  diagnostic_updater::Updater updater_;
  ros_io::LinkReport report_;
  laser::NodeFramerCounters reported_counters_;
  ros::WallTimer watch_timer_;
};

}  // namespace stereo_nav::nodes
