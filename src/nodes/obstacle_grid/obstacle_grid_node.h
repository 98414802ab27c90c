#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <std_srvs/Empty.h>
#include <stereo_msgs/DisparityImage.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "navigation/obstacles/obstacle_map.h"
#include "nodes/obstacle_grid/obstacle_grid_params.h"
#include "nodes/obstacle_grid/obstacle_messages.h"
#include "ros/problem_list.h"

namespace stereo_nav::nodes {

/// Subscribes camera/disparity with both camera_infos (and the rectified images, with `edges`), scan and
/// range/NAME; publishes obstacles and diagnostics; serves obstacles/clear. The nodelet uses the same class.
/// All callbacks run in one thread.
///
/// A message waits for the robot's pose at its stamp. Drop rule: of each input at most kWaiting messages
/// wait; the oldest gives way and is counted, as is one that has waited for `tf_wait_s`.
class ObstacleGridNode {
 public:
  /// Throws ParameterError.
  ObstacleGridNode(ros::NodeHandle handle, ros::NodeHandle private_handle, const std::string& name);

 private:
  /// What waits for the pose of a frame.
  struct Waiting {
    std::string input, frame;
    ros::Time stamp;
    double arrival_s;
    std::function<void(const Eigen::Isometry3d& T_odom_base, const Eigen::Isometry3d& T_base_sensor)> use;
  };

  using Images = std::deque<sensor_msgs::ImageConstPtr>;
  void subscribeImages();
  void handleDisparity(const stereo_msgs::DisparityImage::ConstPtr& message);
  void handleScan(const sensor_msgs::LaserScan::ConstPtr& message);
  void handleRange(const sensor_msgs::Range::ConstPtr& message);
  bool handleClear(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  void handleTimer(const ros::WallTimerEvent& event);
  /// The images that a disparity image is of; empty where they have not come.
  navigation::RectifiedPair imagesOf(const ros::Time& stamp, const cv::Size& size) const;
  void wait(Waiting waiting);
  void useWaiting();
  /// Whether its pose is there; if not, and this was its last chance, that is said.
  bool use(const Waiting& waiting, bool last_chance);
  void publish();
  void raise(const std::string& key, bool is_error, const std::string& text);
  void clear(const std::string& key);
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);

  static constexpr std::size_t kWaiting = 3, kImages = 6;

  ros::NodeHandle handle_, private_handle_;
  std::string name_;
  ObstacleGridParams params_;
  navigation::ObstacleMap map_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  ros::Publisher publisher_;
  sensor_msgs::CameraInfo::ConstPtr left_info_, right_info_;
  Images left_images_, right_images_;
  std::deque<Waiting> waiting_;
  std::vector<navigation::Beam> beams_;
  nav_msgs::OccupancyGrid message_;
  ros::Time newest_;
  bool changed_ = false;
  ros_io::ProblemList problems_;
  diagnostic_updater::Updater updater_;
  double last_input_s_, published_s_ = 0.0, diagnosed_s_ = 0.0;
  std::uint64_t used_ = 0, dropped_ = 0, without_images_ = 0;
  double time_ms_ = 0.0;  ///< of the newest disparity image
  // Last, so that no callback runs any more when the others are destroyed.
  std::vector<ros::Subscriber> subscribers_;
  ros::ServiceServer clear_;
  ros::WallTimer timer_;
};

}  // namespace stereo_nav::nodes
