#include "nodes/laser_odometry/laser_odometry_node.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "core/planar_motion.h"
#include "core/rig_file.h"
#include "nodes/laser_odometry/laser_messages.h"
#include "ros/laser_scan_message.h"
#include "ros/parameter_server.h"
#include "ros/pose_messages.h"
#include "ros/setup_checks.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::nodes {
namespace {

constexpr std::uint32_t kScanQueue = 20;
constexpr std::uint32_t kPriorQueue = 500;
constexpr double kTimerPeriod_s = 0.02;
constexpr double kDiagnosticPeriod_s = 1.0;
/// Wheels and IMU that are further than this from the scans do not help.
constexpr double kOffClock_s = 1.0;

double steadySeconds_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

LaserOdometryNodeParams readLaserParams(const ros::NodeHandle& private_handle) {
  LaserOdometryNodeParams params;
  ros_io::readParameters({ros_io::fileSource(private_handle, "config"),
                          ros_io::serverSource(private_handle, {"rig", "if_in_rig", "diagnostic_period"})},
                         params);
  return params;
}

/// Empty while the samples of `topic` lie near the scans, or there are none.
std::string offClock(const std::string& topic, const std::optional<double>& ahead_s) {
  if (!ahead_s || std::abs(*ahead_s) < kOffClock_s) return "";
  return fmt::format(
      "the newest stamp of {} is {:.1f} s {} that of the scans, so that it is not used: it is silent, or stamped with "
      "another clock than the scans",
      topic, std::abs(*ahead_s), *ahead_s > 0.0 ? "after" : "before");
}

}  // namespace

LaserOdometryNode::LaserOdometryNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                                     const std::string& name)
    : handle_(handle),
      private_handle_(private_handle),
      name_(name),
      params_(readLaserParams(private_handle_)),
      session_(params_.odometry, params_.prior_wait_s),
      health_(handle_, private_handle_, name_),
      tf_listener_(tf_buffer_),
      last_scan_s_(steadySeconds_s()) {
  scan_ = handle_.subscribe(ros_io::topics::kScan, kScanQueue, &LaserOdometryNode::handleScan, this);
  if (params_.wheels)
    wheels_ = handle_.subscribe(ros_io::topics::kWheelOdometry, kPriorQueue, &LaserOdometryNode::handleWheels,
                                this);
  if (params_.imu)
    imu_ = handle_.subscribe(ros_io::topics::kImu, kPriorQueue, &LaserOdometryNode::handleImu, this);
  reset_ = handle_.advertiseService("laser/reset", &LaserOdometryNode::handleReset, this);
  set_pose_ = handle_.advertiseService("laser/set_pose", &LaserOdometryNode::handleSetPose, this);
  // Who sees them advertised knows that the node listens to everything.
  status_publisher_ = handle_.advertise<LaserStatus>(ros_io::topics::kLaserStatus, kScanQueue);
  odometry_publisher_ = handle_.advertise<nav_msgs::Odometry>(ros_io::topics::kLaserOdometry, kScanQueue);
  timer_ = handle_.createWallTimer(ros::WallDuration(kTimerPeriod_s), &LaserOdometryNode::handleTimer, this);
}

std::optional<Eigen::Isometry3d> LaserOdometryNode::mountingOf(const std::string& frame,
                                                               std::string& problem) {
  if (frame == params_.base_frame) return Eigen::Isometry3d::Identity();
  const auto known = mountings_.find(frame);
  if (known != mountings_.end()) return known->second;
  try {
    const auto transform = tf_buffer_.lookupTransform(params_.base_frame, frame, ros::Time(0));
    return mountings_[frame] = ros_io::toIsometry(transform.transform);
  } catch (const tf2::TransformException& error) {
    // REP-120: the base on the floor, which has the base's axes.
    if (frame == ros_io::frames::kFootprint) return Eigen::Isometry3d::Identity();
    problem = ros_io::missingTransform(params_.base_frame, frame, false, error.what());
    return std::nullopt;
  }
}

void LaserOdometryNode::handleScan(const topic_tools::ShapeShifter::ConstPtr& message) {
  last_scan_s_ = steadySeconds_s();
  health_.set("silence", true, "");
  if (message->getDataType() != ros::message_traits::datatype<sensor_msgs::LaserScan>()) {
    health_.set(
        "scan", true,
        fmt::format("{} is {}, expected is sensor_msgs/LaserScan; of a laser with several echoes take "
                    "one (laser_proc)",
                    scan_.getTopic(), message->getDataType()));
    return;
  }
  try {
    addScan(*message->instantiate<sensor_msgs::LaserScan>());
  } catch (const std::exception& error) {  // InputError, or a foreign version of the message
    health_.set("scan", true, error.what());
  }
}

void LaserOdometryNode::addScan(const sensor_msgs::LaserScan& scan) {
  const std::string frame = ros_io::withoutSlash(scan.header.frame_id);
  std::string problem;
  laser_frame_ = frame;
  session_.setMounting(mountingOf(frame, problem));
  session_.addScan(ros_io::toLaserScan(scan), static_cast<std::int64_t>(scan.header.stamp.toNSec()),
                   steadySeconds_s());
  health_.set("scan", true, "");
  publishDue();
}

void LaserOdometryNode::handleWheels(const nav_msgs::Odometry::ConstPtr& message) {
  const auto T_wheels_body = ros_io::toPose(message->pose.pose);
  if (!T_wheels_body) {
    health_.set(
        "wheels", false,
        fmt::format("{} holds no pose: its numbers are NaN, or its quaternion is zero; it is not used",
                    wheels_.getTopic()));
    return;
  }
  const std::string frame = ros_io::withoutSlash(message->child_frame_id);
  std::string problem;
  const auto T_base_body = frame.empty() ? Eigen::Isometry3d::Identity() : mountingOf(frame, problem);
  health_.set("wheels", false,
              T_base_body
                  ? ""
                  : fmt::format("the poses of {} are of {}, which is taken for {}: tf does not know it",
                                wheels_.getTopic(), frame, params_.base_frame));
  const Eigen::Isometry3d T_wheels_base =
      *T_wheels_body * T_base_body.value_or(Eigen::Isometry3d::Identity()).inverse();
  session_.addWheels(message->header.stamp.toSec(), planarPart(T_wheels_base));
  publishDue();
}

void LaserOdometryNode::handleImu(const sensor_msgs::Imu::ConstPtr& message) {
  std::string problem;
  const auto T_base_imu = mountingOf(ros_io::withoutSlash(message->header.frame_id), problem);
  health_.set("imu", false, problem);
  if (!T_base_imu) return;
  session_.addImu(ros_io::toImuSample(*message), T_base_imu->linear());
  publishDue();
}

void LaserOdometryNode::publishDue() {
  const LaserSessionOutput output = session_.take(steadySeconds_s());
  for (const auto& announcement : output.announcements) ROS_WARN_STREAM(name_ << ": " << announcement);
  if (!output.readings.empty() || !output.error.empty()) health_.set("odometry", true, output.error);
  for (const auto& reading : output.readings) publish(reading);
}

void LaserOdometryNode::publish(const LaserReading& reading) {
  const nav_msgs::Odometry odometry = toOdometry(reading, params_.odom_frame, params_.base_frame);
  odometry_publisher_.publish(odometry);
  if (params_.publish_tf) transform_publisher_.publish(odometry);
  status_publisher_.publish(toStatus(reading, session_.counts(), laser_frame_));
  health_.scanDone(reading);
}

bool LaserOdometryNode::handleReset(std_srvs::Empty::Request& /*request*/,
                                    std_srvs::Empty::Response& /*response*/) {
  session_.reset();
  ROS_INFO_STREAM(name_ << ": reset on request; the next scan is the origin");
  return true;
}

bool LaserOdometryNode::handleSetPose(SetPose::Request& request, SetPose::Response& response) {
  const ros_io::GivenPose pose = ros_io::readPose(request.pose, params_.odom_frame);
  response.message = pose.refusal;
  if (!pose.refusal.empty()) {
    ROS_ERROR_STREAM(name_ << ": laser/set_pose refused: " << pose.refusal);
    return true;
  }
  session_.setPose(planarPart(pose.T_odom_base), planarCovariance(pose.covariance));
  response.success = 1;
  return true;
}

void LaserOdometryNode::handleTimer(const ros::WallTimerEvent& /*event*/) {
  publishDue();
  const double now_s = steadySeconds_s();
  if (now_s - diagnosed_s_ < kDiagnosticPeriod_s) return;
  diagnosed_s_ = now_s;
  watchInputs(now_s);
  health_.publish(session_.counts());
}

void LaserOdometryNode::watchInputs(double now_s) {
  if (now_s - last_scan_s_ > params_.input_timeout_s) {
    health_.set("silence", true,
                fmt::format("no message on {} ({} publishers); is the driver of the laser running?",
                            scan_.getTopic(), scan_.getNumPublishers()));
    return;
  }
  if (laser_frame_.empty()) return;
  std::string problem;
  session_.setMounting(mountingOf(laser_frame_, problem));
  health_.set("laser_transform", true, problem);
  health_.set("wheels_clock", false, offClock(wheels_.getTopic(), session_.wheelsAhead_s()));
  health_.set("imu_clock", false, offClock(imu_.getTopic(), session_.imuAhead_s()));
}

}  // namespace stereo_nav::nodes
