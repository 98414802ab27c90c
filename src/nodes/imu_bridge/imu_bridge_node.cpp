#include "nodes/imu_bridge/imu_bridge_node.h"

#include <std_msgs/String.h>

#include <chrono>
#include <filesystem>
#include <sstream>

#include "core/rig_file.h"
#include "nodes/imu_bridge/imu_messages.h"
#include "ros/parameter_server.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {
namespace {

/// Time that the service waits beyond the duration of the measurement.
constexpr double kCalibrationPatience_s = 5.0;

ros_io::ImuBridgeParams readNodeParams(const ros::NodeHandle& private_handle) {
  ros_io::ImuBridgeParams params;
  ros_io::readParameters(
      {ros_io::fileSource(private_handle, "config"), ros_io::rigSource(private_handle, rig_sections::kImu),
       ros_io::serverSource(private_handle, {"diagnostic_period"})},
      params);
  return params;
}

/// Reads the calibration. The file need not exist yet: imu/calibrate_gyro writes it.
imu::ImuCalibration readCalibration(const std::string& path) {
  if (path.empty() || !std::filesystem::exists(path)) return {};
  return imu::loadCalibration(path);
}

}  // namespace

ImuBridgeNode::ImuBridgeNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : handle_(handle),
      private_handle_(private_handle),
      params_(readNodeParams(private_handle_)),
      device_(params_.device, serial::PortFinder(params_.port, params_.by_id_directory)),
      updater_(handle_, private_handle_),
      estimator_(params_.filter, readCalibration(params_.calibration_file), params_.rate_window_s),
      live_parameters_(private_handle_, params_, [this](const ros_io::ImuBridgeParams& params) {
        const std::lock_guard<std::mutex> lock(mutex_);
        live_ = params;
      }) {
  data_ = handle_.advertise<sensor_msgs::Imu>(ros_io::topics::kImu, 100);
  quaternion_ = handle_.advertise<geometry_msgs::Quaternion>(ros_io::topics::kImuQuaternion, 100);
  if (params_.device.protocol != imu::Protocol::kAngles) {
    data_raw_ = handle_.advertise<sensor_msgs::Imu>("imu/data_raw", 100);
  }
  if (params_.chatter) chatter_ = handle_.advertise<std_msgs::String>("chatter", 10);
  calibrate_gyro_ = handle_.advertiseService("imu/calibrate_gyro", &ImuBridgeNode::calibrateGyro, this);
  reset_yaw_ = handle_.advertiseService("imu/reset_yaw", &ImuBridgeNode::resetYaw, this);
  updater_.setHardwareID(params_.port);
  updater_.add("imu", this, &ImuBridgeNode::fillStatus);
  watch_timer_ = handle_.createWallTimer(ros::WallDuration(0.5), &ImuBridgeNode::watch, this);
}

void ImuBridgeNode::run() {
  constexpr double kPoll_s = 0.1;
  while (ros::ok()) {
    device_.poll(kPoll_s, [this](const imu::ImuReading& reading) { publish(reading); });
  }
  calibrated_.notify_all();
}

void ImuBridgeNode::publish(const imu::ImuReading& reading) {
  const ros::Time stamp = stamps_.at(reading.time_s);
  imu::ImuEstimate estimate;
  sensor_msgs::Imu message, message_raw;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    estimate = estimator_.process(reading);
    if (calibrator_ && reading.raw) {
      calibrator_->add(reading.time_s, reading.raw->angular_velocity, reading.raw->linear_acceleration);
      if (calibrator_->complete()) calibrated_.notify_all();
    }
    message = toMessage(estimate, live_, stamp);
    if (reading.raw) {
      const imu::ImuEstimate raw{std::nullopt, reading.raw->angular_velocity,
                                 reading.raw->linear_acceleration};
      message_raw = toMessage(raw, live_, stamp);
    }
  }
  data_.publish(message);
  if (estimate.q_world_imu) quaternion_.publish(toMessage(*estimate.q_world_imu));
  if (reading.raw) data_raw_.publish(message_raw);
  if (params_.chatter && reading.angles) publishAngles(*reading.angles);
}

void ImuBridgeNode::publishAngles(const imu::ModuleAngles& angles) {
  std::ostringstream text;
  text << "yaw: " << angles.yaw_deg << " pitch: " << angles.pitch_deg << " roll: " << angles.roll_deg;
  std_msgs::String message;
  message.data = text.str();
  chatter_.publish(message);
}

bool ImuBridgeNode::calibrateGyro(std_srvs::Trigger::Request& /*request*/,
                                  std_srvs::Trigger::Response& response) {
  if (params_.device.protocol == imu::Protocol::kAngles) {
    response.message =
        "this module sends angles, not rates: it calibrates its own gyroscope when it is switched on at rest";
    return true;
  }
  std::unique_lock<std::mutex> lock(mutex_);
  if (calibrator_) {
    response.message = "a calibration is running already";
    return true;
  }
  calibrator_.emplace(params_.gyro_calibration);
  const auto patience =
      std::chrono::duration<double>(params_.gyro_calibration.duration_s + kCalibrationPatience_s);
  calibrated_.wait_for(lock, patience, [this] { return calibrator_->complete() || !ros::ok(); });
  finishCalibration(calibrator_->result(), response);
  calibrator_.reset();
  return true;
}

/// The caller holds the mutex.
void ImuBridgeNode::finishCalibration(const imu::GyroCalibrator::Result& result,
                                      std_srvs::Trigger::Response& response) {
  response.success = static_cast<unsigned char>(result.accepted);
  response.message = result.message;
  if (!result.accepted) return;
  estimator_.setGyroBias(result.bias);
  if (params_.calibration_file.empty()) {
    response.message += "; used until this node ends (no calibration_file is set)";
    return;
  }
  try {
    imu::saveCalibration(estimator_.calibration(), params_.calibration_file);
    response.message += "; stored in " + params_.calibration_file;
  } catch (const std::exception& error) {
    response.message += std::string("; used, but not stored: ") + error.what();
  }
}

bool ImuBridgeNode::resetYaw(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  estimator_.resetYaw();
  response.success = 1;
  response.message = "the current heading is now zero";
  return true;
}

void ImuBridgeNode::watch(const ros::WallTimerEvent& /*event*/) {
  updater_.update();
  const imu::ImuDeviceStatus status = device_.status();
  report_.log(params_.port, status.state, status.message);
}

void ImuBridgeNode::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const imu::ImuDeviceStatus device = device_.status();
  const auto bad = device.counters.bad_frames - reported_counters_.bad_frames;
  const auto good = device.counters.frames - reported_counters_.frames;
  reported_counters_ = device.counters;
  const bool damaged = 10 * bad > good;
  ros_io::summarise(
      device.state, device.message,
      damaged ? "more than a tenth of the frames are damaged: check cable, ground and baud rate" : "",
      status);
  status.add("port", params_.port);
  status.add("rate (Hz)", device.rate_hz);
  status.add("arrival jitter (ms)", 1e3 * device.arrival_jitter_s);
  status.add("stamp jitter (ms)", 1e3 * device.stamp_jitter_s);
  status.add("frames", device.counters.frames);
  status.add("bad frames", device.counters.bad_frames);
  status.add("lost frames", device.counters.lost_frames);
  status.add("late frames", device.counters.late_frames);
  status.add("bytes", device.counters.bytes);
  status.add("bytes skipped", device.counters.bytes_skipped);
  status.add("connections", device.connections);
}

}  // namespace stereo_nav::nodes
