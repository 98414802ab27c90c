#include "nodes/wheel_odometry/wheel_odometry_node.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "kinematics/drive_file.h"
#include "nodes/wheel_odometry/wheel_messages.h"
#include "ros/parameter_server.h"
#include "ros/pose_messages.h"
#include "ros/setup_checks.h"
#include "ros/wheel_ticks.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::nodes {
namespace {

constexpr std::uint32_t kQueue = 200;
constexpr double kTimerPeriod_s = 0.02;
constexpr double kDiagnosticPeriod_s = 1.0;
constexpr double kRepeat_s = 10.0;
constexpr double kMuchSlip = 3.0;

double steadyNow_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

WheelOdometryNodeParams readWheelParams(const ros::NodeHandle& private_handle) {
  WheelOdometryNodeParams params;
  ros_io::readParameters({ros_io::fileSource(private_handle, "config")}, params);
  ros_io::readParameters({ros_io::rigSource(private_handle, rig_sections::kWheelOdometry)}, params.odometry);
  ros_io::readParameters({ros_io::serverSource(private_handle, {"diagnostic_period"})}, params);
  const auto rig = private_handle.param<std::string>("rig", "");
  if (rig.empty())
    throw ParameterError(
        "~rig is not set; it is the path of the rig file, whose section `drive` describes the wheels");
  params.odometry.drive = kinematics::readDrive(RigFile::load(rig));
  return params;
}

}  // namespace

WheelOdometryNode::WheelOdometryNode(ros::NodeHandle handle, ros::NodeHandle private_handle,
                                     const std::string& name)
    : handle_(std::move(handle)),
      private_handle_(std::move(private_handle)),
      name_(name),
      params_(readWheelParams(private_handle_)),
      session_(params_.odometry, params_.imu_wait_s),
      tf_listener_(tf_buffer_),
      problems_(kRepeat_s),
      updater_(handle_, private_handle_, name_),
      last_ticks_s_(steadyNow_s()) {
  ticks_ = handle_.subscribe(ros_io::topics::kWheelTicks, kQueue, &WheelOdometryNode::handleTicks, this);
  if (params_.imu)
    imu_ = handle_.subscribe(ros_io::topics::kImu, kQueue, &WheelOdometryNode::handleImu, this);
  // Who sees it advertised knows that the node listens to everything.
  odometry_publisher_ = handle_.advertise<nav_msgs::Odometry>(ros_io::topics::kWheelOdometry, kQueue);
  set_pose_ = handle_.advertiseService("wheel/set_pose", &WheelOdometryNode::handleSetPose, this);
  updater_.setHardwareID("none");
  updater_.add("wheel odometry", this, &WheelOdometryNode::fillStatus);
  timer_ = handle_.createWallTimer(ros::WallDuration(kTimerPeriod_s), &WheelOdometryNode::handleTimer, this);
}

void WheelOdometryNode::handleTicks(const WheelTicks::ConstPtr& message) {
  last_ticks_s_ = steadyNow_s();
  clear("silence");
  try {
    session_.addSample(ros_io::toWheelSample(*message, params_.odometry.drive), last_ticks_s_);
    clear("wheel_ticks");
    publishDue();
  } catch (const InputError& error) {
    raise("wheel_ticks", true, error.what());
  }
}

void WheelOdometryNode::handleImu(const sensor_msgs::Imu::ConstPtr& message) {
  if (!session_.knowsImu()) {
    const std::string frame = ros_io::withoutSlash(message->header.frame_id);
    try {
      Eigen::Matrix3d R_base_imu = Eigen::Matrix3d::Identity();
      if (frame != params_.base_frame) {
        const auto transform = tf_buffer_.lookupTransform(params_.base_frame, frame, ros::Time(0));
        R_base_imu = ros_io::toIsometry(transform.transform).linear();
      }
      session_.setImuMounting(R_base_imu);
      clear("imu");
      ROS_INFO_STREAM(name_ << ": the yaw comes from the IMU " << frame);
    } catch (const tf2::TransformException& error) {
      raise("imu", false, ros_io::missingTransform(params_.base_frame, frame, false, error.what()));
      return;
    }
  }
  session_.addImu(ros_io::toImuSample(*message));
  publishDue();
}

void WheelOdometryNode::publishDue() {
  const WheelSessionOutput output = session_.take(steadyNow_s());
  for (const auto& announcement : output.announcements) ROS_WARN_STREAM(name_ << ": " << announcement);
  for (const auto& result : output.results) {
    const nav_msgs::Odometry odometry = toOdometry(result, params_.odom_frame, params_.base_frame);
    odometry_publisher_.publish(odometry);
    if (params_.publish_tf) transform_publisher_.publish(odometry);
    watch(result);
  }
}

void WheelOdometryNode::watch(const odometry::WheelOdometryResult& result) {
  last_ = result;
  if (result.problem.empty()) {
    clear("encoders");
  } else {
    raise("encoders", true, result.problem);
  }
  if (result.slip < kMuchSlip) {
    clear("slip");
    return;
  }
  raise(
      "slip", false,
      fmt::format(
          "the wheels contradict each other, or the IMU, {:.1f} times as much as expected: they slip, or the "
          "geometry is wrong; drive more gently, or find it by calibrate_wheels",
          result.slip));
}

bool WheelOdometryNode::handleSetPose(SetPose::Request& request, SetPose::Response& response) {
  const ros_io::GivenPose pose = ros_io::readPose(request.pose, params_.odom_frame);
  response.message = pose.refusal;
  if (!pose.refusal.empty()) {
    ROS_ERROR_STREAM(name_ << ": wheel/set_pose refused: " << pose.refusal);
    return true;
  }
  const Eigen::Isometry2d T_odom_base = planarPart(pose.T_odom_base);
  session_.setPose(T_odom_base, inAxesOf(T_odom_base.inverse(), planarCovariance(pose.covariance)));
  response.success = 1;
  return true;
}

void WheelOdometryNode::handleTimer(const ros::WallTimerEvent& /*event*/) {
  publishDue();
  const double now_s = steadyNow_s();
  if (now_s - last_ticks_s_ > params_.input_timeout_s) {
    raise("silence", true,
          fmt::format("no message on {} ({} publishers); is the driver of the wheels running?",
                      ticks_.getTopic(), ticks_.getNumPublishers()));
  }
  if (now_s - diagnosed_s_ < kDiagnosticPeriod_s) return;
  diagnosed_s_ = now_s;
  updater_.force_update();
}

void WheelOdometryNode::raise(const std::string& key, bool is_error, const std::string& text) {
  if (!problems_.raise(key, is_error, text, steadyNow_s())) return;
  if (is_error) {
    ROS_ERROR_STREAM(name_ << ": " << text);
  } else {
    ROS_WARN_STREAM(name_ << ": " << text);
  }
}

void WheelOdometryNode::clear(const std::string& key) {
  if (problems_.clear(key)) ROS_INFO_STREAM(name_ << ": over: " << key);
}

void WheelOdometryNode::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  status.summary(Level::OK, session_.readings() == 0 ? "waiting for wheel_ticks" : "running");
  for (const auto& problem : problems_.all())
    status.mergeSummary(problem.second.is_error ? Level::ERROR : Level::WARN, problem.second.text);
  status.add("readings", session_.readings());
  status.add("readings dropped (late or repeated)", session_.readingsDropped());
  status.add("readings without the IMU's yaw", session_.readingsWithoutImu());
  status.add("IMU", session_.knowsImu() ? "used" : "not used");
  status.addf("slip, 1 is expected", "%.2f", last_.slip);
  status.addf("drift of the IMU's yaw [deg/s]", "%.4f", last_.yaw_drift_rad_per_s * kDegPerRad);
  status.addf("speed [m/s], turning [rad/s]", "%.3f, %.3f", last_.twist.head<2>().norm(), last_.twist.z());
}

}  // namespace stereo_nav::nodes
