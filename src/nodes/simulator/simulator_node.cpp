#include "nodes/simulator/simulator_node.h"

#include <algorithm>
#include <utility>

#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {
namespace {

namespace topics = ros_io::topics;

constexpr std::uint32_t kQueue = 10;

}  // namespace

SimulatorNode::SimulatorNode(ros::NodeHandle& node, const sim::Simulation& simulation,
                             const SimulatorParams& params, const Eigen::Isometry3d& T_base_imu)
    : simulation_(simulation),
      params_(params),
      start_(ros::Time::now() + ros::Duration(params.start_delay_s)),
      messages_(simulation, start_, T_base_imu),
      transport_(node),
      left_image_(transport_.advertise(topics::kLeftImage, kQueue)),
      right_image_(transport_.advertise(topics::kRightImage, kQueue)),
      left_info_(node.advertise<sensor_msgs::CameraInfo>(topics::kLeftInfo, kQueue)),
      right_info_(node.advertise<sensor_msgs::CameraInfo>(topics::kRightInfo, kQueue)),
      sync_(node.advertise<StereoSync>(topics::kSync, kQueue)),
      imu_(node.advertise<sensor_msgs::Imu>(topics::kImu, 10 * kQueue)),
      imu_quaternion_(node.advertise<geometry_msgs::Quaternion>(topics::kImuQuaternion, 10 * kQueue)),
      ground_truth_(node.advertise<nav_msgs::Odometry>(topics::kGroundTruth, kQueue)),
      waypoint_(node.advertise<geometry_msgs::PointStamped>(topics::kWaypoint, kQueue)),
      updater_(node, ros::NodeHandle("~")) {
  if (params_.publish_tf_static) {
    tf_static_ = node.advertise<tf2_msgs::TFMessage>("/tf_static", 1, true);
    tf_static_.publish(messages_.staticTransforms());
  }
  if (!simulation_.wheels().empty())
    wheel_ticks_ = node.advertise<WheelTicks>(topics::kWheelTicks, 10 * kQueue);
  updater_.setHardwareID("none");
  updater_.add("simulated sensors", this, &SimulatorNode::fillStatus);
  timer_ =
      node.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { updater_.update(); });
}

void SimulatorNode::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  const std::uint64_t late = pairs_late_;
  if (late != std::exchange(pairs_late_reported_, late)) {
    status.summary(Level::WARN, "pairs are dropped: this machine does not render them in real time");
  } else {
    status.summary(Level::OK, pairs_published_ == 0 ? "about to start" : "driving");
  }
  status.add("scenario", params_.scenario);
  status.add("pairs published", pairs_published_);
  status.add("pairs dropped as too late", late);
  status.addf("drive lasts [s]", "%.1f", simulation_.duration_s());
}

void SimulatorNode::renderAhead() {
  const auto threads = static_cast<std::size_t>(params_.threads);
  const auto& pairs = simulation_.pairs();
  while (rendering_.size() < threads && next_to_render_ < pairs.size()) {
    const std::size_t index = next_to_render_++;
    // A pair that cannot be ready in time is skipped: rendering it would make the next ones late, too.
    if (pairs[index].left_s < now_s() + rendering_s_ - 0.5 * lateTolerance_s()) {
      countLate();
      continue;
    }
    rendering_.push_back(std::async(std::launch::async, [this, index] {
      const ros::WallTime begin = ros::WallTime::now();
      ros_io::PairMessages pair = messages_.pair(index);
      rendering_s_ = (ros::WallTime::now() - begin).toSec();
      return pair;
    }));
  }
}

void SimulatorNode::countLate() {
  ++pairs_late_;
  ROS_WARN_THROTTLE(
      5.0,
      "%lu of %lu pairs came too late and were dropped: this machine does not render them in real "
      "time. Lower rig/samples_per_pixel or rig/image_scale, or raise ~threads.",
      static_cast<unsigned long>(pairs_late_), static_cast<unsigned long>(next_to_render_));
}

void SimulatorNode::publishUntil(double time_s) {
  const auto& imu = simulation_.imu();
  for (; next_imu_ < imu.size() && imu[next_imu_].time_s <= time_s; ++next_imu_) {
    imu_.publish(messages_.imu(next_imu_));
    if (messages_.hasAttitude()) imu_quaternion_.publish(messages_.imuQuaternion(next_imu_));
  }
  const auto& wheels = simulation_.wheels();
  for (; next_ticks_ < wheels.size() && wheels[next_ticks_].time_s <= time_s; ++next_ticks_) {
    wheel_ticks_.publish(messages_.wheelTicks(next_ticks_));
  }
  const auto& waypoints = simulation_.trajectory().waypoints();
  for (; next_waypoint_ < waypoints.size() && waypoints[next_waypoint_].time_s <= time_s; ++next_waypoint_) {
    waypoint_.publish(messages_.waypoint(next_waypoint_));
  }
}

void SimulatorNode::publishPair(const ros_io::PairMessages& pair) {
  sync_.publish(pair.sync);
  left_info_.publish(pair.left_info);
  right_info_.publish(pair.right_info);
  left_image_.publish(pair.left);
  right_image_.publish(pair.right);
  ground_truth_.publish(pair.ground_truth);
  ++pairs_published_;
}

void SimulatorNode::run() {
  renderAhead();
  while (ros::ok() && !rendering_.empty()) {
    const ros_io::PairMessages pair = rendering_.front().get();
    rendering_.pop_front();
    renderAhead();
    // This step is much shorter than the usual period of IMU messages.
    for (double now = now_s(); now < pair.available_s && ros::ok(); now = now_s()) {
      publishUntil(now);
      ros::WallDuration(std::min(0.004, pair.available_s - now)).sleep();
    }
    publishUntil(pair.available_s);
    if (now_s() > pair.available_s + lateTolerance_s()) {
      countLate();
      continue;
    }
    publishPair(pair);
  }
  ROS_INFO("simulated drive done: %lu pairs, %lu dropped as too late",
           static_cast<unsigned long>(next_to_render_), static_cast<unsigned long>(pairs_late_));
}

}  // namespace stereo_nav::nodes
