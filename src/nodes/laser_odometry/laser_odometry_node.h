#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/transform_listener.h>
#include <topic_tools/shape_shifter.h>

#include <map>
#include <optional>
#include <string>

#include "nodes/laser_odometry/laser_health.h"
#include "nodes/laser_odometry/laser_odometry_node_params.h"
#include "nodes/laser_odometry/laser_session.h"
#include "ros/odom_transform_publisher.h"
#include "stereo_nav/SetPose.h"

namespace stereo_nav::nodes {

/// Subscribes scan, wheel/odom and imu/data; publishes laser/odom, laser/status and diagnostics; serves
/// laser/reset and laser/set_pose. The nodelet uses the same class with its own handles. All callbacks run in
/// one thread.
class LaserOdometryNode {
 public:
  /// Throws ParameterError.
  LaserOdometryNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                    const std::string& name);

 private:
  void handleScan(const topic_tools::ShapeShifter::ConstPtr& message);
  void addScan(const sensor_msgs::LaserScan& scan);
  void handleWheels(const nav_msgs::Odometry::ConstPtr& message);
  void handleImu(const sensor_msgs::Imu::ConstPtr& message);
  bool handleReset(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  bool handleSetPose(SetPose::Request& request, SetPose::Response& response);
  void handleTimer(const ros::WallTimerEvent& event);

  std::optional<Eigen::Isometry3d> mountingOf(const std::string& frame, std::string& problem);
  void publishDue();
  void publish(const LaserReading& reading);
  void watchInputs(double now_s);

  ros::NodeHandle handle_, private_handle_;
  std::string name_;
  LaserOdometryNodeParams params_;
  LaserSession session_;
  LaserHealth health_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  std::map<std::string, Eigen::Isometry3d> mountings_;  ///< by frame
  std::string laser_frame_;                             ///< of the last scan
  ros_io::OdomTransformPublisher transform_publisher_;
  ros::Publisher odometry_publisher_, status_publisher_;
  ros::Subscriber scan_, wheels_, imu_;
  ros::ServiceServer reset_, set_pose_;
  ros::WallTimer timer_;
  double last_scan_s_;
  double diagnosed_s_ = 0.0;
};

}  // namespace stereo_nav::nodes
