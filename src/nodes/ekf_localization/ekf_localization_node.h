#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>
#include <std_srvs/SetBool.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <string>
#include <vector>

#include "estimation/ekf/fusion_filter.h"
#include "estimation/ekf/fusion_setup.h"
#include "ros/fusion_messages.h"

namespace stereo_nav::nodes {

/// Subscribes the sensors of its parameters and `set_pose`; publishes `odometry/filtered`, tf and
/// diagnostics; serves `reset`, `toggle` and `enable`. Driven by its messages: what they leave is published
/// `frequency` times a second. All callbacks run in one thread.
class EkfLocalizationNode {
 public:
  /// Throws ParameterError.
  EkfLocalizationNode(ros::NodeHandle handle, ros::NodeHandle private_handle, const std::string& name);

 private:
  void subscribe(std::size_t sensor);
  template <class Message>
  void subscribeAs(std::size_t sensor);
  void take(std::size_t sensor, const std::vector<estimation::Measurement>& measurements);
  void publish(double now_s);
  void publishTransform(const estimation::FusedEstimate& estimate);
  void handleSetPose(const geometry_msgs::PoseWithCovarianceStamped& message);
  void handleTransforms(const ros::MessageEvent<const tf2_msgs::TFMessage>& event);
  bool handleReset(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  bool handleEnable(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  bool handleToggle(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle handle_, private_handle_;
  std::string name_;
  estimation::FusionConfig config_;
  estimation::FusionSetup setup_;
  estimation::FusionFilter filter_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  ros_io::FusionMessages messages_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher odometry_, acceleration_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
  std::vector<double> heard_s_;  ///< last message of each sensor
  double next_s_ = 0.0;
  double published_s_ = 0.0;
  bool enabled_ = true;
  std::string other_publisher_;  ///< of our transform
  double busy_s_ = 0.0;          ///< since the last diagnostics
  std::size_t taken_ = 0;
};

}  // namespace stereo_nav::nodes
