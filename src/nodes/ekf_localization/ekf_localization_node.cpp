#include "nodes/ekf_localization/ekf_localization_node.h"

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "nodes/ekf_localization/filtered_messages.h"
#include "ros/parameter_server.h"
#include "ros/pose_messages.h"
#include "ros/setup_checks.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::nodes {
namespace {

using NodeClock = std::chrono::steady_clock;
constexpr double kDiagnosticPeriod_s = 1.0;

/// The file `~config`, overlaid by what lies in the node's namespace, where roslaunch's rosparam puts a file.
estimation::FusionConfig readConfig(const ros::NodeHandle& private_handle) {
  const ros_io::ParameterSource file = ros_io::fileSource(private_handle, "config");
  const ros_io::ParameterSource server = ros_io::serverSource(private_handle, {"diagnostic_period"});
  YAML::Node all = file.tree.IsMap() ? YAML::Clone(file.tree) : YAML::Node(YAML::NodeType::Map);
  for (const auto& entry : server.tree) all[entry.first.as<std::string>()] = entry.second;
  return estimation::readFusionConfig(all, file.tree.IsMap() ? file.name : server.name);
}

}  // namespace

EkfLocalizationNode::EkfLocalizationNode(ros::NodeHandle handle, ros::NodeHandle private_handle,
                                         const std::string& name)
    : handle_(std::move(handle)),
      private_handle_(std::move(private_handle)),
      name_(name),
      config_(readConfig(private_handle_)),
      setup_(estimation::setUp(config_)),
      filter_(config_.params.filter, setup_.parts, setup_.channels),
      tf_listener_(tf_buffer_),
      messages_(
          config_, setup_,
          [this](const std::string& frame) -> std::optional<Eigen::Isometry3d> {
            try {
              return ros_io::toIsometry(
                  tf_buffer_.lookupTransform(config_.params.base_link_frame, frame, ros::Time(0)).transform);
            } catch (const tf2::TransformException& error) {
              ROS_WARN_STREAM_THROTTLE(10.0, name_ << ": "
                                                   << ros_io::missingTransform(config_.params.base_link_frame,
                                                                               frame, false, error.what()));
              return std::nullopt;
            }
          }),
      updater_(handle_, private_handle_, name_),
      heard_s_(config_.sensors.size(), 0.0),
      enabled_(!config_.params.disabled_at_startup) {
  for (const std::string& note : config_.notes) ROS_INFO_STREAM(name_ << ": " << note);
  for (std::size_t sensor = 0; sensor < config_.sensors.size(); ++sensor) subscribe(sensor);
  subscribers_.push_back(handle_.subscribe("set_pose", 1, &EkfLocalizationNode::handleSetPose, this));
  if (config_.params.publish_tf)
    subscribers_.push_back(handle_.subscribe("/tf", 100, &EkfLocalizationNode::handleTransforms, this));
  if (config_.params.publish_acceleration)
    acceleration_ = handle_.advertise<geometry_msgs::AccelWithCovarianceStamped>("accel/filtered", 20);
  services_ = {handle_.advertiseService("reset", &EkfLocalizationNode::handleReset, this),
               handle_.advertiseService("enable", &EkfLocalizationNode::handleEnable, this),
               handle_.advertiseService("toggle", &EkfLocalizationNode::handleToggle, this)};
  // Who sees it advertised knows that the node listens to everything.
  odometry_ = handle_.advertise<nav_msgs::Odometry>("odometry/filtered", 20);
  updater_.setHardwareID("none");
  updater_.add("fusion", this, &EkfLocalizationNode::fillStatus);
  timer_ = handle_.createWallTimer(ros::WallDuration(kDiagnosticPeriod_s),
                                   [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

template <class Message>
void EkfLocalizationNode::subscribeAs(std::size_t sensor) {
  const estimation::SensorConfig& config = config_.sensors[sensor];
  ros::TransportHints hints;
  if (config.params.nodelay) hints = hints.tcpNoDelay();
  const boost::function<void(const typename Message::ConstPtr&)> handle =
      [this, sensor](const typename Message::ConstPtr& message) {
        take(sensor, messages_.convert(sensor, *message));
      };
  const auto queue = static_cast<std::uint32_t>(std::max(config.params.queue_size, 50));
  subscribers_.push_back(handle_.subscribe<Message>(config.topic, queue, handle, ros::VoidConstPtr(), hints));
}

void EkfLocalizationNode::subscribe(std::size_t sensor) {
  switch (config_.sensors[sensor].type) {
    case estimation::SensorType::kOdometry:
      return subscribeAs<nav_msgs::Odometry>(sensor);
    case estimation::SensorType::kPose:
      return subscribeAs<geometry_msgs::PoseWithCovarianceStamped>(sensor);
    case estimation::SensorType::kTwist:
      return subscribeAs<geometry_msgs::TwistWithCovarianceStamped>(sensor);
    case estimation::SensorType::kImu:
      return subscribeAs<sensor_msgs::Imu>(sensor);
    case estimation::SensorType::kFix:
      return subscribeAs<sensor_msgs::NavSatFix>(sensor);
  }
}

void EkfLocalizationNode::take(std::size_t sensor, const std::vector<estimation::Measurement>& measurements) {
  const double now_s = ros::Time::now().toSec();
  heard_s_[sensor] = now_s;
  if (!enabled_) return;
  const auto start = NodeClock::now();
  for (const estimation::Measurement& measurement : measurements) filter_.add(measurement, now_s);
  busy_s_ += std::chrono::duration<double>(NodeClock::now() - start).count();
  taken_ += measurements.size();
  for (const std::string& text : filter_.takeAnnouncements()) ROS_WARN_STREAM(name_ << ": " << text);
  if (filter_.started()) publish(now_s);
}

void EkfLocalizationNode::publish(double now_s) {
  const double period_s = 1.0 / config_.params.frequency_hz;
  if (now_s < next_s_ && next_s_ < now_s + 2.0 * period_s) return;
  next_s_ = std::max(next_s_ + period_s, now_s);
  if (next_s_ > now_s + 2.0 * period_s) next_s_ = now_s;
  const estimation::FusedEstimate estimate =
      filter_.estimate(config_.params.predict_to_current_time ? now_s : filter_.time_s());
  if (estimate.time_s == published_s_) return;
  published_s_ = estimate.time_s;
  odometry_.publish(toOdometry(estimate, config_.params));
  if (config_.params.publish_acceleration) acceleration_.publish(toAcceleration(estimate, config_.params));
  if (config_.params.publish_tf) publishTransform(estimate);
}

void EkfLocalizationNode::publishTransform(const estimation::FusedEstimate& estimate) {
  const estimation::FusionParams& params = config_.params;
  const double time_s = estimate.time_s + params.transform_time_offset_s;
  if (params.world_frame == params.odom_frame) {
    broadcaster_.sendTransform(
        toTransform(estimate.T_world_base, params.odom_frame, params.base_link_frame, time_s));
    return;
  }
  try {
    const auto T_odom_base =
        tf_buffer_.lookupTransform(params.odom_frame, params.base_link_frame, ros::Time(0));
    const Eigen::Isometry3d T_map_odom =
        estimate.T_world_base * ros_io::toIsometry(T_odom_base.transform).inverse();
    broadcaster_.sendTransform(toTransform(T_map_odom, params.map_frame, params.odom_frame, time_s));
  } catch (const tf2::TransformException& error) {
    ROS_WARN_STREAM_THROTTLE(10.0, name_ << ": no transform " << params.map_frame << " -> "
                                         << params.odom_frame << " is published, since nobody publishes "
                                         << params.odom_frame << " -> " << params.base_link_frame << " ("
                                         << error.what() << "); start the filter of the odom frame, too");
  }
}

void EkfLocalizationNode::handleTransforms(const ros::MessageEvent<const tf2_msgs::TFMessage>& event) {
  const estimation::FusionParams& params = config_.params;
  const std::string& child =
      params.world_frame == params.odom_frame ? params.base_link_frame : params.odom_frame;
  if (!other_publisher_.empty() || event.getPublisherName() == ros::this_node::getName()) return;
  for (const auto& transform : event.getMessage()->transforms) {
    if (ros_io::withoutSlash(transform.child_frame_id) != child) continue;
    other_publisher_ = event.getPublisherName();
    ROS_ERROR_STREAM(
        name_ << ": " << other_publisher_ << " publishes the transform to " << child
              << ", too: the pose jumps between the two; set publish_tf to false in one of them");
    return;
  }
}

void EkfLocalizationNode::handleSetPose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  const ros_io::GivenPose pose = ros_io::readPose(message, config_.params.world_frame);
  if (!pose.refusal.empty()) {
    ROS_ERROR_STREAM(name_ << ": set_pose refused: " << pose.refusal);
    return;
  }
  filter_.setPose(pose.T_odom_base, pose.covariance);
  messages_.reset();
}

bool EkfLocalizationNode::handleReset(std_srvs::Empty::Request& /*request*/,
                                      std_srvs::Empty::Response& /*response*/) {
  filter_.reset();
  messages_.reset();
  next_s_ = published_s_ = 0.0;
  return true;
}

bool EkfLocalizationNode::handleEnable(std_srvs::Empty::Request& /*request*/,
                                       std_srvs::Empty::Response& /*response*/) {
  enabled_ = true;
  return true;
}

bool EkfLocalizationNode::handleToggle(std_srvs::SetBool::Request& request,
                                       std_srvs::SetBool::Response& response) {
  response.success = 1;
  response.message = request.data != 0 ? "measurements are taken in" : "measurements are left out";
  enabled_ = request.data != 0;
  return true;
}

void EkfLocalizationNode::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  status.summary(Level::OK, !enabled_           ? "switched off (enable, toggle)"
                            : filter_.started() ? "running"
                                                : "waiting for a sensor");
  const double now_s = ros::Time::now().toSec();
  for (std::size_t i = 0; i < heard_s_.size(); ++i) {
    if (now_s - heard_s_[i] > config_.params.sensor_timeout_s)
      status.mergeSummary(
          Level::WARN, fmt::format("{} ({}) is silent", config_.sensors[i].name, config_.sensors[i].topic));
  }
  if (!other_publisher_.empty())
    status.mergeSummary(Level::ERROR, other_publisher_ + " publishes the same transform");
  for (std::size_t i = 0; i < setup_.channels.size(); ++i) {
    const estimation::ChannelStatistics& channel = filter_.statistics()[i];
    status.add(setup_.channels[i].name,
               fmt::format("{} used, {} refused, {} set aside, {} too late, {} ahead, NIS per field {:.2f}",
                           channel.used, channel.refused, channel.aside, channel.too_late, channel.ahead,
                           channel.nis_fields > 0.0 ? channel.nis_sum / channel.nis_fields : 0.0));
  }
  status.add("us per measurement", taken_ > 0 ? 1e6 * busy_s_ / static_cast<double>(taken_) : 0.0);
  status.add("bytes of history", filter_.historyBytes());
  busy_s_ = 0.0;
  taken_ = 0;
}

}  // namespace stereo_nav::nodes
