#pragma once

#include <geometry_msgs/Quaternion.h>
#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

#include "nodes/visual_odometry/health.h"
#include "nodes/visual_odometry/odometry_session.h"
#include "ros/inbox.h"
#include "ros/input_monitor.h"
#include "ros/running_clock.h"

namespace stereo_nav::nodes {

/// The subscriptions of the odometry. Assembles frames for the inbox and watches the topics for silence. The
/// callbacks only queue. They and the public functions that are not marked otherwise must be called from one
/// thread.
class OdometryInputs {
 public:
  /// Subscribes at once; `inbox` and `health` must outlive this object.
  OdometryInputs(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                 const VisualOdometryParams& params, const ros_io::FrameSynchroniserParams& synchronisation,
                 ros_io::Inbox& inbox, Health& health);

  /// Applies changes by dynamic_reconfigure.
  void applyLive(const VisualOdometryParams& params) { monitor_.setTimeout(params.input_timeout_s); }
  /// Must be called a few times per second: time passes only here and in the callbacks.
  void tick() { clock_.seconds(); }
  /// Reports to `health` which topics are silent, which do not fit together, and what was dropped since the
  /// last report.
  void report();

  /// The latest data besides the frames, and the number of frames. Thread-safe.
  SensorSetup setup() const;
  FrameCounts counts() const;

 private:
  void watchAll();
  std::size_t watch(const std::string& topic, bool stamped, const std::string& remedy,
                    std::function<unsigned int()> publishers);
  void subscribe();
  ros::Subscriber subscribeInfo(const std::string& topic, sensor_msgs::CameraInfoConstPtr& slot,
                                std::size_t input);
  void subscribeImu();

  void handleLeft(const sensor_msgs::ImageConstPtr& image);
  void handleRight(const sensor_msgs::ImageConstPtr& image);
  void handleDisparity(const stereo_msgs::DisparityImageConstPtr& disparity);
  void handleSync(const StereoSyncConstPtr& sync);
  void handleImu(const sensor_msgs::ImuConstPtr& imu);
  void handleQuaternion(const geometry_msgs::QuaternionConstPtr& quaternion);
  void addImuSample(const ImuSample& sample, const std::string& frame_id);
  void passOnFrames();
  std::string newDrops();
  std::string calibrationProblem();

  ros::NodeHandle handle_;
  ros::NodeHandle private_handle_;
  VisualOdometryParams params_;
  ros_io::Inbox& inbox_;
  Health& health_;

  ros_io::FrameSynchroniser synchroniser_;
  ros_io::RunningClock clock_;
  ros_io::InputMonitor monitor_;
  std::size_t left_input_ = 0, right_input_ = 0, left_info_input_ = 0, right_info_input_ = 0,
              disparity_input_ = 0, imu_input_ = 0;
  bool uses_disparity_ = false;
  std::uint64_t imu_refused_ = 0;
  std::uint64_t dropped_reported_ = 0;
  SensorSetup judged_setup_;  ///< whose calibration the problem below is
  std::string calibration_problem_;

  mutable std::mutex mutex_;  ///< guards the two below
  SensorSetup setup_;
  FrameCounts counts_;

  image_transport::ImageTransport image_transport_;
  image_transport::Subscriber left_, right_;
  ros::Subscriber disparity_, sync_, left_info_, right_info_, imu_;
};

}  // namespace stereo_nav::nodes
