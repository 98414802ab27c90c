#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Range.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimation/range_correction/range_corrector.h"
#include "nodes/range_correction/range_correction_params.h"
#include "ros/problem_list.h"

namespace stereo_nav::nodes {

/// Subscribes map, initialpose, odom and range/NAME; publishes range/pose (in the map), tf map -> odom and
/// diagnostics. The odometry arrives as tf odom -> base_link, whoever publishes it, and is never touched; its
/// covariance as the message that goes with it.
///
/// A reading waits for the pose of its stamp. Drop rule: of each range finder at most kWaiting wait; the
/// oldest gives way and is counted.
class RangeCorrectionNode {
 public:
  /// Throws ParameterError.
  RangeCorrectionNode(ros::NodeHandle handle, ros::NodeHandle private_handle, const std::string& name);

 private:
  struct Finder {
    std::string name;
    std::unique_ptr<tf2_ros::MessageFilter<sensor_msgs::Range>> waiting;
    ros::Subscriber subscriber;
    int foreign = 0;  ///< measurements without a wall, in succession
  };

  void setInitialPose();
  void subscribe(std::size_t sensor);
  void handleMap(const nav_msgs::OccupancyGrid& message);
  void handlePose(const geometry_msgs::PoseWithCovarianceStamped& message);
  void handleOdometry(const nav_msgs::Odometry& message);
  void handleRange(std::size_t sensor, const sensor_msgs::Range& message);
  void judge(Finder& finder, estimation::RangeOutcome outcome);
  void publishPose(const ros::Time& stamp);
  void publishTransform(const ros::Time& stamp);
  void handleTimer(const ros::WallTimerEvent& event);
  void raise(const std::string& key, const std::string& text);
  void clear(const std::string& key);
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);

  static constexpr std::uint32_t kWaiting = 20;

  ros::NodeHandle handle_, private_handle_;
  std::string name_;
  RangeCorrectionParams params_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  std::vector<Finder> finders_;  ///< after the buffer, which they leave when they end
  estimation::RangeCorrector corrector_;
  std::optional<Eigen::Matrix3d> odom_covariance_;  ///< x, y, yaw, of the newest message
  bool has_map_ = false;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher pose_;
  ros::Time sent_;  ///< the last transform
  std::uint64_t without_echo_ = 0, dropped_ = 0;
  double last_input_s_;
  ros_io::ProblemList problems_;
  diagnostic_updater::Updater updater_;
  // Last, so that no callback runs any more when the others are destroyed.
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer timer_;
};

}  // namespace stereo_nav::nodes
