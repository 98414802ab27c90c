#pragma once

#include <dynamic_reconfigure/server.h>
#include <geometry_msgs/Quaternion.h>
#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "stereo_nav/SetPose.h"
#include "stereo_nav/UncertaintyConfig.h"
#include "stereo_nav/VisualOdometryConfig.h"
#include "stereo_nav/nodes/disparity_view.h"
#include "stereo_nav/nodes/health.h"
#include "stereo_nav/nodes/inbox.h"
#include "stereo_nav/nodes/input_monitor.h"
#include "stereo_nav/nodes/odometry_publisher.h"
#include "stereo_nav/nodes/odometry_session.h"

namespace stereo_nav::nodes {

/// The visual_odometry node; the nodelet is the same object on the nodelet's handles. Callbacks only queue;
/// one thread runs the odometry and publishes. The handles' callbacks must come from one thread.
class VisualOdometryNode {
 public:
  /// Throws ParameterError.
  VisualOdometryNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                     const std::string& name);
  ~VisualOdometryNode();

 private:
  void offerReconfiguration();
  void subscribe();
  void subscribeImu();
  std::size_t watch(const std::string& topic, bool stamped, const std::string& remedy,
                    std::function<unsigned int()> publishers);

  void handleLeft(const sensor_msgs::ImageConstPtr& image);
  void handleRight(const sensor_msgs::ImageConstPtr& image);
  void handleDisparity(const stereo_msgs::DisparityImageConstPtr& disparity);
  void handleSync(const StereoSyncConstPtr& sync);
  void handleInfo(sensor_msgs::CameraInfoConstPtr& slot, std::size_t input,
                  const sensor_msgs::CameraInfoConstPtr& info);
  void handleImu(const sensor_msgs::ImuConstPtr& imu);
  void handleQuaternion(const geometry_msgs::QuaternionConstPtr& quaternion);
  void addImuSample(const vo::ImuSample& sample, const std::string& frame_id);
  void passOnFrames();

  bool handleReset(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  bool handleSetPose(SetPose::Request& request, SetPose::Response& response);
  void handleTimer(const ros::WallTimerEvent& event);

  void work();
  void processFrame(const Inbox::Work& work);
  double watchedSeconds();
  std::string newDrops();

  ros::NodeHandle handle_;
  ros::NodeHandle private_handle_;
  std::string name_;
  VisualOdometryParams params_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  Health health_;

  // Of the callback thread.
  FrameSynchroniser synchroniser_;
  std::unique_ptr<InputMonitor> monitor_;
  std::size_t left_input_ = 0, right_input_ = 0, disparity_input_ = 0, imu_input_ = 0;
  double watched_s_ = 0.0;
  ros::Time last_ros_time_;
  SteadyTime last_steady_time_;
  unsigned int ticks_ = 0;
  std::uint64_t lefts_received_ = 0;
  std::uint64_t imu_refused_ = 0;
  std::uint64_t dropped_reported_ = 0;

  // Between the threads.
  Inbox inbox_;
  std::mutex setup_mutex_;
  SensorSetup setup_;
  FrameCounts counts_;  ///< under setup_mutex_
  std::mutex session_mutex_;
  OdometrySession session_;
  OdometryPublisher publisher_;  ///< under session_mutex_

  DisparityView disparity_view_;
  image_transport::ImageTransport image_transport_;
  image_transport::Subscriber left_subscriber_, right_subscriber_;
  ros::Subscriber disparity_subscriber_, sync_subscriber_, left_info_subscriber_, right_info_subscriber_,
      imu_subscriber_;
  ros::ServiceServer reset_service_, set_pose_service_;
  std::unique_ptr<dynamic_reconfigure::Server<VisualOdometryConfig>> reconfigure_server_;
  std::unique_ptr<dynamic_reconfigure::Server<UncertaintyConfig>>
      uncertainty_server_;  ///< below ~uncertainty
  ros::WallTimer timer_;
  std::thread worker_;
};

}  // namespace stereo_nav::nodes
