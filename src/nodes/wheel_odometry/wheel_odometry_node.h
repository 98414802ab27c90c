#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <tf2_ros/transform_listener.h>

#include <string>

#include "nodes/wheel_odometry/wheel_odometry_node_params.h"
#include "nodes/wheel_odometry/wheel_session.h"
#include "ros/odom_transform_publisher.h"
#include "ros/problem_list.h"
#include "stereo_nav/SetPose.h"
#include "stereo_nav/WheelTicks.h"

namespace stereo_nav::nodes {

/// Subscribes wheel_ticks and imu/data, publishes wheel/odom and diagnostics, serves wheel/set_pose. All
/// callbacks run in one thread.
class WheelOdometryNode {
 public:
  /// Throws ParameterError.
  WheelOdometryNode(ros::NodeHandle handle, ros::NodeHandle private_handle, const std::string& name);

 private:
  void handleTicks(const WheelTicks::ConstPtr& message);
  void handleImu(const sensor_msgs::Imu::ConstPtr& message);
  bool handleSetPose(SetPose::Request& request, SetPose::Response& response);
  void handleTimer(const ros::WallTimerEvent& event);
  void publishDue();
  void watch(const odometry::WheelOdometryResult& result);
  void raise(const std::string& key, bool is_error, const std::string& text);
  void clear(const std::string& key);
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle handle_, private_handle_;
  std::string name_;
  WheelOdometryNodeParams params_;
  WheelSession session_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  ros_io::OdomTransformPublisher transform_publisher_;
  ros::Publisher odometry_publisher_;
  ros::Subscriber ticks_, imu_;
  ros::ServiceServer set_pose_;
  ros_io::ProblemList problems_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
  double last_ticks_s_;
  double diagnosed_s_ = 0.0;
  odometry::WheelOdometryResult last_;
};

}  // namespace stereo_nav::nodes
