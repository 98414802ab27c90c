#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <std_msgs/Float64.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include "nodes/base_bridge/base_control.h"
#include "nodes/base_bridge/base_publishers.h"
#include "ros/problem_list.h"
#include "sensors/base/base_device.h"

namespace stereo_nav::nodes {

/// The microcontroller of a base on ROS topics: cmd_vel, joints/* and actuators/* become commands, its
/// telemetry becomes wheel_ticks, joint_states, range/*, battery, switch/* and actuators/*/state; services
/// base/stop and base/release.
///
/// run() talks to the controller in the calling thread; callbacks and services run in other threads.
class BaseBridgeNode {
 public:
  /// Throws ParameterError.
  BaseBridgeNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  /// Works until ROS shuts down, and then tells the controller that nothing moves.
  void run();

 private:
  void subscribe();
  void handleReading(const base::BaseReading& reading);
  void handleVelocity(const geometry_msgs::Twist::ConstPtr& message);
  void handleOrder(const std::string& topic, const std::optional<std::string>& refusal);
  bool handleStop(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool handleRelease(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool waitForController() const;
  void sendDue();
  void watch(const ros::WallTimerEvent& event);
  void raise(const std::string& key, bool is_error, const std::string& text);
  void clear(const std::string& key);
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle handle_, private_handle_;
  const ros_io::BaseBridgeParams params_;
  const kinematics::DriveParams drive_;
  base::BaseDevice device_;
  BasePublishers publishers_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<std::string> order_topics_;  ///< of cmd_vel, joints and actuators
  ros::ServiceServer stop_, release_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer watch_timer_;
  double next_command_s_ = 0.0;
  std::atomic<bool> is_urgent_{false};  ///< the next command must not wait for its period

  mutable std::mutex mutex_;  ///< guards what follows
  BaseControl control_;
  base::Telemetry telemetry_{};
  ros_io::ProblemList problems_;
};

}  // namespace stereo_nav::nodes
