#include "nodes/range_correction/range_correction_node.h"

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include <cmath>
#include <sstream>
#include <utility>

#include "core/planar_motion.h"
#include "ros/grid_messages.h"
#include "ros/parameter_server.h"
#include "ros/pose_messages.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::nodes {
namespace {

using estimation::RangeOutcome;
constexpr double kDiagnosticPeriod_s = 1.0;
constexpr double kRepeat_s = 10.0;
constexpr double kTransformPeriod_s = 0.05;
constexpr double kLargestTilt = 0.05;  ///< sine of a beam's angle to the floor
constexpr int kForeignInSuccession = 20;

RangeCorrectionParams readRangeParams(const ros::NodeHandle& private_handle) {
  RangeCorrectionParams params;
  ros_io::readParameters({ros_io::fileSource(private_handle, "config"),
                          ros_io::serverSource(private_handle, {"diagnostic_period"})},
                         params);
  return params;
}

std::vector<std::string> namesIn(const std::string& list) {
  std::istringstream stream(list);
  std::vector<std::string> names;
  for (std::string name; stream >> name;) names.push_back(name);
  return names;
}

bool saysARange(const sensor_msgs::Range& message) {
  return std::isfinite(message.range) && message.range >= message.min_range &&
         message.range < message.max_range;
}

double wallNow_s() {
  return ros::WallTime::now().toSec();
}

}  // namespace

RangeCorrectionNode::RangeCorrectionNode(ros::NodeHandle handle, ros::NodeHandle private_handle,
                                         const std::string& name)
    : handle_(std::move(handle)),
      private_handle_(std::move(private_handle)),
      name_(name),
      params_(readRangeParams(private_handle_)),
      tf_listener_(tf_buffer_),
      finders_(namesIn(params_.ranges).size()),
      corrector_(params_.correction, finders_.size()),
      last_input_s_(wallNow_s()),
      problems_(kRepeat_s),
      updater_(handle_, private_handle_, name_) {
  setInitialPose();
  for (std::size_t sensor = 0; sensor < finders_.size(); ++sensor) subscribe(sensor);
  subscribers_ = {handle_.subscribe("map", 1, &RangeCorrectionNode::handleMap, this),
                  handle_.subscribe("odom", 10, &RangeCorrectionNode::handleOdometry, this),
                  handle_.subscribe("initialpose", 1, &RangeCorrectionNode::handlePose, this)};
  updater_.setHardwareID("none");
  updater_.add("range correction", this, &RangeCorrectionNode::fillStatus);
  timer_ = handle_.createWallTimer(ros::WallDuration(kDiagnosticPeriod_s), &RangeCorrectionNode::handleTimer,
                                   this);
  // Who sees it advertised knows that the node listens to everything.
  pose_ = handle_.advertise<geometry_msgs::PoseWithCovarianceStamped>("range/pose", 10);
}

void RangeCorrectionNode::setInitialPose() {
  Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
  T.translation() << params_.initial_x_m, params_.initial_y_m;
  T.linear() = Eigen::Rotation2Dd(params_.initial_yaw_rad).toRotationMatrix();
  const Eigen::Vector3d sigma(params_.initial_sigma_m, params_.initial_sigma_m, params_.initial_sigma_rad);
  corrector_.setPose(T, sigma.cwiseAbs2().asDiagonal());
}

void RangeCorrectionNode::subscribe(std::size_t sensor) {
  using Filter = tf2_ros::MessageFilter<sensor_msgs::Range>;
  Finder& finder = finders_[sensor];
  finder.name = namesIn(params_.ranges)[sensor];
  finder.waiting = std::make_unique<Filter>(tf_buffer_, params_.odom_frame, kWaiting, handle_);
  const boost::function<void(const sensor_msgs::Range::ConstPtr&)> use =
      [this, sensor](const sensor_msgs::Range::ConstPtr& message) { handleRange(sensor, *message); };
  finder.waiting->registerCallback(use);
  finder.waiting->registerFailureCallback(
      [this, sensor](const sensor_msgs::Range::ConstPtr& message, tf2_ros::FilterFailureReason /*reason*/) {
        ++dropped_;
        raise("tf", fmt::format("range/{} dropped: no pose of {} in {} for its stamp; is an odometry running "
                                "that publishes {} -> {}, and is the range finder's mounting in tf?",
                                finders_[sensor].name, message->header.frame_id, params_.odom_frame,
                                params_.odom_frame, params_.base_frame));
      });
  finder.subscriber =
      handle_.subscribe<sensor_msgs::Range>(ros_io::topics::kRange + finder.name, kWaiting,
                                            [this, sensor](const sensor_msgs::Range::ConstPtr& message) {
                                              last_input_s_ = wallNow_s();
                                              finders_[sensor].waiting->add(message);
                                            });
}

void RangeCorrectionNode::handleMap(const nav_msgs::OccupancyGrid& message) {
  try {
    corrector_.setMap(ros_io::toGrid(message));
    has_map_ = true;
    clear("map");
  } catch (const InputError& error) {
    raise("map", error.what());
  }
}

void RangeCorrectionNode::handlePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  ros_io::GivenPose pose = ros_io::readPose(message, params_.map_frame);
  const Eigen::Matrix3d covariance = planarCovariance(pose.covariance);
  if (pose.refusal.empty() && !(covariance.diagonal().minCoeff() > 0.0))
    pose.refusal = "the variances of x, y and yaw must be above zero";
  if (!pose.refusal.empty()) {
    ROS_ERROR_STREAM(name_ << ": initialpose refused: " << pose.refusal);
    return;
  }
  corrector_.setPose(planarPart(pose.T_odom_base), covariance);
  for (Finder& finder : finders_) judge(finder, RangeOutcome::kUsed);
}

/// Without a usable covariance the parameters alone say how the pose becomes uncertain.
void RangeCorrectionNode::handleOdometry(const nav_msgs::Odometry& message) {
  if (message.header.frame_id != params_.odom_frame || message.child_frame_id != params_.base_frame) {
    raise(
        "odometry",
        fmt::format("the covariances of `odom` are not used: they are of {} in {}, tf is asked for {} in {}; "
                    "remap `odom` to the odometry that publishes this transform",
                    message.child_frame_id, message.header.frame_id, params_.base_frame, params_.odom_frame));
    return;
  }
  clear("odometry");
  const Eigen::Matrix3d covariance = planarCovariance(ros_io::toCovariance(message.pose.covariance));
  if (covariance.allFinite()) odom_covariance_ = covariance;
}

void RangeCorrectionNode::handleRange(std::size_t sensor, const sensor_msgs::Range& message) {
  if (!has_map_) return;
  const std::string frame = message.header.frame_id;
  const auto at = [&](const std::string& to, const std::string& from) {
    return ros_io::toIsometry(tf_buffer_.lookupTransform(to, from, message.header.stamp).transform);
  };
  Eigen::Isometry3d T_base_sensor, T_odom_base;
  try {
    T_base_sensor = at(params_.base_frame, frame);
    T_odom_base = at(params_.odom_frame, params_.base_frame);
    clear("tf");
  } catch (const tf2::TransformException& error) {
    ++dropped_;
    raise("tf", fmt::format("range/{} dropped: {}", finders_[sensor].name, error.what()));
    return;
  }
  if (std::abs(T_base_sensor.linear()(2, 0)) > kLargestTilt) {
    raise(
        finders_[sensor].name,
        fmt::format(
            "range/{} is not used: its beam leaves the level by {:.1f} degrees, so that it does not meet the "
            "map's walls; correct the transform of {}, or leave it out of `ranges`",
            finders_[sensor].name, std::asin(T_base_sensor.linear()(2, 0)) * 180.0 / M_PI, frame));
    return;
  }
  if (!saysARange(message)) {
    ++without_echo_;
    return;
  }
  estimation::RangeReading reading;
  reading.sensor = sensor;
  reading.time_s = message.header.stamp.toSec();
  reading.T_base_sensor = planarPart(T_base_sensor);
  reading.half_width_rad = 0.5 * double{message.field_of_view};
  reading.nearest = message.radiation_type == sensor_msgs::Range::ULTRASOUND;
  reading.range_m = message.range;
  reading.max_range_m = message.max_range;
  const RangeOutcome outcome = corrector_.add(reading, planarPart(T_odom_base), odom_covariance_);
  judge(finders_[sensor], outcome);
  if (outcome == RangeOutcome::kUsed) publishPose(message.header.stamp);
  publishTransform(message.header.stamp);
}

void RangeCorrectionNode::judge(Finder& finder, RangeOutcome outcome) {
  if (outcome == RangeOutcome::kForeign && ++finder.foreign >= kForeignInSuccession) {
    raise(finder.name,
          fmt::format("range/{}: {} measurements in succession that no wall of the map explains; is "
                      "something before it, is its mounting right, or the pose (initialpose)?",
                      finder.name, finder.foreign));
  }
  if (outcome != RangeOutcome::kUsed) return;
  finder.foreign = 0;
  clear(finder.name);
}

void RangeCorrectionNode::publishPose(const ros::Time& stamp) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = params_.map_frame;
  message.pose.pose = tf2::toMsg(inSpace(corrector_.T_map_base()));
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.pose.covariance.data()) =
      spatialCovariance(corrector_.covariance());
  pose_.publish(message);
}

void RangeCorrectionNode::publishTransform(const ros::Time& stamp) {
  if (!params_.publish_tf || std::abs((stamp - sent_).toSec()) < kTransformPeriod_s) return;
  sent_ = stamp;
  geometry_msgs::TransformStamped transform = tf2::eigenToTransform(inSpace(corrector_.T_map_odom()));
  transform.header.stamp = stamp + ros::Duration(params_.transform_tolerance_s);
  transform.header.frame_id = params_.map_frame;
  transform.child_frame_id = params_.odom_frame;
  broadcaster_.sendTransform(transform);
}

void RangeCorrectionNode::handleTimer(const ros::WallTimerEvent& /*event*/) {
  if (!has_map_) raise("map", "no map so far: is map_image_server running (map.launch)?");
  if (wallNow_s() - last_input_s_ > params_.input_timeout_s) {
    raise("silence", "nothing on any of range/* (" + params_.ranges + "); are the range finders running?");
  } else {
    clear("silence");
  }
  updater_.force_update();
}

void RangeCorrectionNode::raise(const std::string& key, const std::string& text) {
  if (problems_.raise(key, true, text, wallNow_s())) ROS_ERROR_STREAM(name_ << ": " << text);
}

void RangeCorrectionNode::clear(const std::string& key) {
  if (problems_.clear(key)) ROS_INFO_STREAM(name_ << ": over: " << key);
}

void RangeCorrectionNode::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  status.summary(Level::OK, corrector_.count(RangeOutcome::kUsed) == 0 ? "waiting for readings" : "running");
  for (const auto& problem : problems_.all()) status.mergeSummary(Level::ERROR, problem.second.text);
  status.add("measurements used", corrector_.count(RangeOutcome::kUsed));
  status.add("measurements whose wall is uncertain", corrector_.count(RangeOutcome::kAmbiguous));
  status.add("measurements without a wall", corrector_.count(RangeOutcome::kForeign));
  status.add("readings without an echo", without_echo_);
  status.add("readings dropped (no pose in time, or newer ones came)", dropped_);
  for (std::size_t sensor = 0; sensor < finders_.size(); ++sensor)
    status.addf("error of range/" + finders_[sensor].name + " [m]", "%.3f", corrector_.bias_m(sensor));
}

}  // namespace stereo_nav::nodes
