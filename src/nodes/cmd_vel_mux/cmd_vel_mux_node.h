#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>

#include <optional>
#include <vector>

#include "nodes/cmd_vel_mux/velocity_mux.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::nodes {

struct CmdVelMuxParams {
  double stop_timeout_s = 0.5;
  double manual_timeout_s = 0.5;
  double auto_timeout_s = 0.5;

  void describe(ParameterVisitor& visitor);
};

/// cmd_vel_stop over cmd_vel_manual over cmd_vel_auto, to cmd_vel. What comes on cmd_vel_stop stops, whatever
/// it holds. When the source that had the word falls silent, one zero velocity is published, so that nothing
/// drives on until another source begins.
class CmdVelMuxNode {
 public:
  /// Throws ParameterError.
  CmdVelMuxNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle);

 private:
  void handle(std::size_t source, const geometry_msgs::Twist& message);
  void watch(const ros::WallTimerEvent& event);
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);

  VelocityMux mux_;
  ros::Publisher publisher_;
  std::vector<ros::Subscriber> subscribers_;
  std::optional<std::size_t> active_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace stereo_nav::nodes
