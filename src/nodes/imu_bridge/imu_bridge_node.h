#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <condition_variable>
#include <mutex>
#include <optional>

#include "ros/imu_bridge_params.h"
#include "ros/link_report.h"
#include "ros/live_parameters.h"
#include "ros/steady_stamps.h"
#include "sensors/imu/imu_estimator.h"

namespace stereo_nav::nodes {

/// A serial IMU module on ROS topics: imu/data, imu/data_raw (raw modules), imu_quat, chatter.
///
/// run() reads the module in the calling thread; services and diagnostics run in other threads.
class ImuBridgeNode {
 public:
  /// Throws ParameterError.
  ImuBridgeNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  /// Works until ROS shuts down.
  void run();

 private:
  void publish(const imu::ImuReading& reading);
  void publishAngles(const imu::ModuleAngles& angles);
  bool calibrateGyro(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool resetYaw(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  void finishCalibration(const imu::GyroCalibrator::Result& result, std_srvs::Trigger::Response& response);
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);
  void watch(const ros::WallTimerEvent& event);

  ros::NodeHandle handle_, private_handle_;
  const ros_io::ImuBridgeParams params_;  ///< values at the start
  imu::ImuDevice device_;
  ros::Publisher data_, data_raw_, quaternion_, chatter_;
  ros::ServiceServer calibrate_gyro_, reset_yaw_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer watch_timer_;
  ros_io::SteadyStamps stamps_;

  std::mutex mutex_;              ///< guards estimator, calibrator and live_
  ros_io::ImuBridgeParams live_;  ///< current values, as set by dynamic_reconfigure
  std::condition_variable calibrated_;
  imu::ImuEstimator estimator_;
  std::optional<imu::GyroCalibrator> calibrator_;

  ros_io::LinkReport report_;
  imu::DecoderCounters reported_counters_;
  ros_io::LiveParameters<ros_io::ImuBridgeParams> live_parameters_;
};

}  // namespace stereo_nav::nodes
