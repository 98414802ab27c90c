#include "nodes/visual_odometry/visual_odometry_node.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/rig_file.h"
#include "ros/parameter_server.h"
#include "ros/pose_messages.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::nodes {
namespace {

/// Names in the private namespace that are read elsewhere.
const std::set<std::string> kForeignParameters = {"vo", "rig", "image_transport", "diagnostic_period"};

constexpr double kTimerPeriod_s = 0.25;
constexpr unsigned int kTicksPerReport = 4;

VisualOdometryParams readNodeParams(const ros::NodeHandle& private_handle) {
  VisualOdometryParams params;
  ros_io::readParameters({ros_io::rigSource(private_handle, rig_sections::kUncertainty)}, params.uncertainty);
  ros_io::readParameters({ros_io::serverSource(private_handle, kForeignParameters)}, params);
  params.waiting.wait_for_imu = params.imu != VisualOdometryParams::Imu::kNone;
  return params;
}

odometry::OdometryConfig readOdometryConfig(const ros::NodeHandle& private_handle) {
  odometry::OdometryConfig config;
  ros_io::readParameters({ros_io::fileSource(private_handle, "config"),
                          ros_io::serverSource(ros::NodeHandle(private_handle, "vo"))},
                         config);
  return config;
}

ros_io::FrameSynchroniserParams synchroniserParams(ros_io::FrameSynchroniserParams params,
                                                   const odometry::OdometryConfig& config) {
  params.disparity = config.disparityUse();
  return params;
}

/// Waits up to 0.2 s, only once: a bag's transforms and first images arrive at the same time, and its first
/// frame must be the origin. At the time of an image, for which tf may be up to 0.1 s late: a servo may have
/// turned since. What is fixed is known for any time, and nothing waits for it.
TransformLookup lookupIn(tf2_ros::Buffer& buffer) {
  constexpr int kTries = 20;
  return [&buffer, tries_left = kTries](const std::string& target, const std::string& source,
                                        const ros::Time& time,
                                        std::string& error) mutable -> std::optional<Eigen::Isometry3d> {
    for (; tries_left > 0 && !buffer.canTransform(target, source, ros::Time(0)); --tries_left) {
      ros::WallDuration(0.01).sleep();  // the ROS clock may stand still
    }
    const bool is_known = buffer.canTransform(target, source, ros::Time(0));
    for (int late = 0; is_known && late < 10 && !buffer.canTransform(target, source, time); ++late)
      ros::WallDuration(0.01).sleep();
    try {
      return ros_io::toIsometry(buffer.lookupTransform(target, source, time).transform);
    } catch (const tf2::TransformException& exception) {
      error = exception.what();
      return std::nullopt;
    }
  };
}

/// Whether the stamps follow the running clock of this host and are not those of a replay.
bool isLive(const ros::Time& stamp) {
  constexpr double kLive_s = 5.0;
  return !ros::Time::isSimTime() && std::abs((ros::Time::now() - stamp).toSec()) < kLive_s;
}

}  // namespace

VisualOdometryNode::VisualOdometryNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                                       const std::string& name)
    : handle_(handle),
      private_handle_(private_handle),
      name_(name),
      params_(readNodeParams(private_handle_)),
      tf_listener_(tf_buffer_),
      health_(handle_, private_handle_, name),
      inbox_(params_.waiting),
      session_(params_, readOdometryConfig(private_handle_), lookupIn(tf_buffer_)),
      inputs_(handle_, private_handle_, params_,
              synchroniserParams(params_.synchronisation, readOdometryConfig(private_handle_)), inbox_,
              health_),
      publisher_(handle_, params_),
      disparity_view_(handle_) {
  worker_ = std::thread(&VisualOdometryNode::work, this);
  reset_service_ = handle_.advertiseService("vo/reset", &VisualOdometryNode::handleReset, this);
  set_pose_service_ = handle_.advertiseService("vo/set_pose", &VisualOdometryNode::handleSetPose, this);
  live_parameters_ = std::make_unique<ros_io::LiveParameters<VisualOdometryParams>>(
      private_handle_, params_, [this](const VisualOdometryParams& params) { applyLive(params); });
  timer_ = handle_.createWallTimer(ros::WallDuration(kTimerPeriod_s), &VisualOdometryNode::handleTimer, this);
}

VisualOdometryNode::~VisualOdometryNode() {
  inbox_.stop();
  worker_.join();
}

void VisualOdometryNode::applyLive(const VisualOdometryParams& params) {
  inputs_.applyLive(params);
  const std::lock_guard<std::mutex> lock(session_mutex_);
  publisher_.applyLive(params);
  session_.applyLive(params);
}

bool VisualOdometryNode::handleReset(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
  const std::lock_guard<std::mutex> lock(session_mutex_);
  session_.reset();
  publisher_.forgetPath();
  ROS_INFO_STREAM(name_ << ": reset on request; the next frame is the origin");
  return true;
}

bool VisualOdometryNode::handleSetPose(SetPose::Request& request, SetPose::Response& response) {
  const ros_io::GivenPose pose = ros_io::readPose(request.pose, params_.odom_frame);
  response.message = pose.refusal;
  if (pose.refusal.empty()) {
    const std::lock_guard<std::mutex> lock(session_mutex_);
    response.success = static_cast<std::uint8_t>(session_.setPose(pose.T_odom_base, pose.covariance));
    if (response.success == 0) response.message = "no odometry yet: it still waits for its inputs";
  }
  if (response.success == 0) ROS_ERROR_STREAM(name_ << ": vo/set_pose refused: " << response.message);
  return true;
}

void VisualOdometryNode::handleTimer(const ros::WallTimerEvent&) {
  inputs_.tick();
  if (++ticks_ % kTicksPerReport != 0) return;
  inputs_.report();
  health_.publishDiagnostics();
}

void VisualOdometryNode::work() {
  while (const auto work = inbox_.waitAndTake()) {
    try {
      processFrame(*work);
    } catch (const std::exception& error) {
      // One frame must not end the process, least of all a manager that also runs other nodelets.
      ROS_ERROR_STREAM(name_ << ": frame " << work->frame.left_stamp << " is skipped: " << error.what());
    }
  }
}

void VisualOdometryNode::processFrame(const ros_io::Inbox::Work& work) {
  FrameCounts counts = inputs_.counts();
  SessionOutput output;
  {
    const std::lock_guard<std::mutex> lock(session_mutex_);
    output = session_.process(work, inputs_.setup(), isLive(work.frame.left_stamp));
    counts.lost = session_.framesLost();
    if (work.frame.after_jump) publisher_.forgetPath();
    publisher_.publish(work.frame, output, counts);
  }
  const std::chrono::duration<double, std::milli> latency =
      std::chrono::steady_clock::now() - work.frame.arrival;
  for (const auto& note : output.notes) ROS_INFO_STREAM(name_ << ": " << note);
  for (const auto& announcement : output.announcements) ROS_WARN_STREAM(name_ << ": " << announcement);
  health_.replace("setup: ", true, output.errors);
  health_.replace("quality: ", false, output.warnings);
  health_.frameDone(output, counts, latency.count());
}

}  // namespace stereo_nav::nodes
