#include "nodes/obstacle_grid/obstacle_grid_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <utility>

#include "ros/grid_messages.h"
#include "ros/parameter_server.h"
#include "ros/setup_checks.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::nodes {
namespace {

constexpr double kTimerPeriod_s = 0.01;
constexpr double kDiagnosticPeriod_s = 1.0;
constexpr double kRepeat_s = 10.0;

double steadyNow_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

ObstacleGridParams readObstacleParams(const ros::NodeHandle& private_handle) {
  ObstacleGridParams params;
  ros_io::readParameters({ros_io::fileSource(private_handle, "config"),
                          ros_io::serverSource(private_handle, {"diagnostic_period"})},
                         params);
  return params;
}

}  // namespace

ObstacleGridNode::ObstacleGridNode(ros::NodeHandle handle, ros::NodeHandle private_handle,
                                   const std::string& name)
    : handle_(std::move(handle)),
      private_handle_(std::move(private_handle)),
      name_(name),
      params_(readObstacleParams(private_handle_)),
      map_(params_.grid),
      tf_listener_(tf_buffer_),
      problems_(kRepeat_s),
      updater_(handle_, private_handle_, name_),
      last_input_s_(steadyNow_s()) {
  using Info = sensor_msgs::CameraInfo;
  subscribers_ = {handle_.subscribe<Info>(ros_io::topics::kLeftInfo, 1,
                                          [this](const Info::ConstPtr& info) { left_info_ = info; }),
                  handle_.subscribe<Info>(ros_io::topics::kRightInfo, 1,
                                          [this](const Info::ConstPtr& info) { right_info_ = info; }),
                  handle_.subscribe("camera/disparity", 1, &ObstacleGridNode::handleDisparity, this),
                  handle_.subscribe(ros_io::topics::kScan, kWaiting, &ObstacleGridNode::handleScan, this)};
  std::istringstream names(params_.ranges);
  for (std::string range; names >> range;)
    subscribers_.push_back(
        handle_.subscribe(ros_io::topics::kRange + range, kWaiting, &ObstacleGridNode::handleRange, this));
  if (params_.edges) subscribeImages();
  clear_ = handle_.advertiseService("obstacles/clear", &ObstacleGridNode::handleClear, this);
  // Who sees it advertised knows that the node listens to everything.
  publisher_ = handle_.advertise<nav_msgs::OccupancyGrid>("obstacles", 1);
  updater_.setHardwareID("none");
  updater_.add("obstacle grid", this, &ObstacleGridNode::fillStatus);
  timer_ = handle_.createWallTimer(ros::WallDuration(kTimerPeriod_s), &ObstacleGridNode::handleTimer, this);
}

void ObstacleGridNode::handleDisparity(const stereo_msgs::DisparityImage::ConstPtr& message) {
  wait({"disparity", message->header.frame_id, message->header.stamp, steadyNow_s(),
        [this, message](const Eigen::Isometry3d& T_odom_base, const Eigen::Isometry3d& T_base_camera) {
          if (!left_info_ || !right_info_)
            throw InputError(
                "disparity images, but no camera_info of both cameras; are they of one namespace?");
          const double start_s = steadyNow_s();
          const vision::StereoCalibration calibration = ros_io::toCalibration(*left_info_, *right_info_);
          const navigation::DisparityCamera camera{calibration.fx,
                                                   calibration.fy,
                                                   calibration.cx,
                                                   calibration.cy,
                                                   calibration.baseline_m,
                                                   T_base_camera,
                                                   calibration.right_cx - calibration.cx};
          const cv::Mat disparity = ros_io::toDisparityMap(*message, calibration);
          const navigation::RectifiedPair images = imagesOf(message->header.stamp, disparity.size());
          if (params_.edges && images.left.empty()) ++without_images_;
          map_.addDisparity(message->header.stamp.toSec(), disparity, camera, T_odom_base, images);
          time_ms_ = 1e3 * (steadyNow_s() - start_s);
        }});
}

void ObstacleGridNode::subscribeImages() {
  const auto subscribe = [this](const char* topic, Images& images) {
    subscribers_.push_back(handle_.subscribe<sensor_msgs::Image>(
        topic, kWaiting, [&images](const sensor_msgs::ImageConstPtr& image) {
          if (images.size() == kImages) images.pop_front();
          images.push_back(image);
        }));
  };
  subscribe("camera/left/image_rect", left_images_);
  subscribe("camera/right/image_rect", right_images_);
}

navigation::RectifiedPair ObstacleGridNode::imagesOf(const ros::Time& stamp, const cv::Size& size) const {
  const auto find = [&](const Images& images) {
    const auto found = std::find_if(images.begin(), images.end(),
                                    [&](const auto& image) { return image->header.stamp == stamp; });
    return found == images.end() ? cv::Mat() : ros_io::toMono8(*found);
  };
  const navigation::RectifiedPair pair{find(left_images_), find(right_images_)};
  return pair.left.size() == size && pair.right.size() == size ? pair : navigation::RectifiedPair();
}

void ObstacleGridNode::handleScan(const sensor_msgs::LaserScan::ConstPtr& message) {
  // The whole scan is placed by the pose in the middle of its sweep.
  const double half_s = 0.5 * double{message->time_increment} * static_cast<double>(message->ranges.size());
  wait({"scan", message->header.frame_id, message->header.stamp + ros::Duration(half_s), steadyNow_s(),
        [this, message](const Eigen::Isometry3d& T_odom_base, const Eigen::Isometry3d& T_base_laser) {
          toBeams(*message, params_.grid.size_m, beams_);
          map_.addScan(message->header.stamp.toSec(), beams_, T_odom_base * T_base_laser);
        }});
}

void ObstacleGridNode::handleRange(const sensor_msgs::Range::ConstPtr& message) {
  wait({"range", message->header.frame_id, message->header.stamp, steadyNow_s(),
        [this, message](const Eigen::Isometry3d& T_odom_base, const Eigen::Isometry3d& T_base_finder) {
          const auto beam = toBeam(*message, params_.grid.size_m);
          if (beam) map_.addRange(message->header.stamp.toSec(), *beam, T_odom_base * T_base_finder);
        }});
}

void ObstacleGridNode::wait(Waiting waiting) {
  last_input_s_ = waiting.arrival_s;
  waiting.frame = ros_io::withoutSlash(waiting.frame);
  const auto same = [&](const Waiting& other) {
    return other.input == waiting.input && other.frame == waiting.frame;
  };
  if (static_cast<std::size_t>(std::count_if(waiting_.begin(), waiting_.end(), same)) >= kWaiting) {
    const auto oldest = std::find_if(waiting_.begin(), waiting_.end(), same);
    if (!use(*oldest, true)) ++dropped_;
    waiting_.erase(oldest);
  }
  waiting_.push_back(std::move(waiting));
  useWaiting();
}

void ObstacleGridNode::useWaiting() {
  const double now_s = steadyNow_s();
  for (auto waiting = waiting_.begin(); waiting != waiting_.end();) {
    const bool overdue = now_s - waiting->arrival_s >= params_.tf_wait_s;
    const bool done = use(*waiting, overdue);
    if (!done && !overdue) {
      ++waiting;
      continue;
    }
    if (!done) ++dropped_;
    waiting = waiting_.erase(waiting);
  }
}

bool ObstacleGridNode::use(const Waiting& waiting, bool last_chance) {
  try {
    const auto T_base_sensor = tf_buffer_.lookupTransform(params_.base_frame, waiting.frame, waiting.stamp);
    const auto T_odom_base =
        tf_buffer_.lookupTransform(params_.odom_frame, params_.base_frame, waiting.stamp);
    const Eigen::Isometry3d pose = ros_io::toIsometry(T_odom_base.transform);
    map_.follow(pose.translation().head<2>());
    waiting.use(pose, ros_io::toIsometry(T_base_sensor.transform));
    clear("tf");
    clear(waiting.input);
  } catch (const tf2::TransformException& error) {
    if (last_chance) {
      raise(
          "tf", true,
          fmt::format(
              "{} dropped: no pose of {} for its stamp ({}); is an odometry running that publishes {} -> {}?",
              waiting.input, waiting.frame, error.what(), params_.odom_frame, params_.base_frame));
    }
    return false;
  } catch (const InputError& error) {
    raise(waiting.input, true, error.what());
    ++dropped_;
    return true;
  }
  ++used_;
  changed_ = true;
  newest_ = std::max(newest_, waiting.stamp);
  return true;
}

bool ObstacleGridNode::handleClear(std_srvs::Empty::Request& /*request*/,
                                   std_srvs::Empty::Response& /*response*/) {
  map_.clear();
  changed_ = true;
  return true;
}

void ObstacleGridNode::handleTimer(const ros::WallTimerEvent& /*event*/) {
  useWaiting();
  const double now_s = steadyNow_s();
  if (changed_ && now_s - published_s_ >= 1.0 / params_.publish_rate_hz) {
    published_s_ = now_s;
    publish();
  }
  if (now_s - last_input_s_ > params_.input_timeout_s) {
    raise("silence", true,
          "nothing on camera/disparity, scan and range/*; are cameras, laser or range finders running?");
  } else {
    clear("silence");
  }
  if (now_s - diagnosed_s_ < kDiagnosticPeriod_s) return;
  diagnosed_s_ = now_s;
  updater_.force_update();
}

void ObstacleGridNode::publish() {
  changed_ = false;
  ros_io::fillMessage(map_.grid(), params_.odom_frame, newest_, message_);
  publisher_.publish(message_);
}

void ObstacleGridNode::raise(const std::string& key, bool is_error, const std::string& text) {
  if (!problems_.raise(key, is_error, text, steadyNow_s())) return;
  if (is_error) {
    ROS_ERROR_STREAM(name_ << ": " << text);
  } else {
    ROS_WARN_STREAM(name_ << ": " << text);
  }
}

void ObstacleGridNode::clear(const std::string& key) {
  if (problems_.clear(key)) ROS_INFO_STREAM(name_ << ": over: " << key);
}

void ObstacleGridNode::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  status.summary(Level::OK, used_ == 0 ? "waiting for camera/disparity, scan or range/*" : "running");
  for (const auto& problem : problems_.all())
    status.mergeSummary(problem.second.is_error ? Level::ERROR : Level::WARN, problem.second.text);
  status.add("messages used", used_);
  status.add("messages dropped (no pose in time, newer ones came, or refused)", dropped_);
  status.add("disparity images without their rectified images", without_images_);
  status.addf("time of the newest disparity image [ms]", "%.2f", time_ms_);
}

}  // namespace stereo_nav::nodes
