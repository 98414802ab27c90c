#include "nodes/navigator/navigator_inputs.h"

#include <fmt/format.h>

#include <cmath>

#include "core/planar_motion.h"
#include "ros/setup_checks.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::nodes {
NavigatorInputs::NavigatorInputs(ros::NodeHandle& handle, const NavigatorNodeParams& params,
                                 navigator::GridRoutePlanner& planner)
    : params_(params), planner_(planner), tf_listener_(tf_buffer_) {
  const auto newest = ros::TransportHints().tcpNoDelay();
  odometry_subscriber_ = handle.subscribe("odom", 1, &NavigatorInputs::handleOdometry, this, newest);
  subscribers_ = {
      handle.subscribe<VoStatus>("vo/status", 1, [this](const VoStatus::ConstPtr& m) { vo_status_ = m; }),
      handle.subscribe("obstacles", 1, &NavigatorInputs::handleObstacles, this, newest),
      handle.subscribe("map", 1, &NavigatorInputs::handleMap, this)};
}

void NavigatorInputs::handleOdometry(const nav_msgs::Odometry::ConstPtr& message) {
  const std::string child = ros_io::withoutSlash(message->child_frame_id);
  if (child != params_.base_frame) {
    tell("odometry", fmt::format("{} tells the pose of `{}`, not of `{}`; set base_frame, or remap odom",
                                 odometryTopic(), child, params_.base_frame));
    return;
  }
  tell("odometry", "");
  odometry_ = message;
}

void NavigatorInputs::handleObstacles(const nav_msgs::OccupancyGrid::ConstPtr& message) {
  const std::string frame = ros_io::withoutSlash(message->header.frame_id);
  const std::string odom_frame = odometry_ ? ros_io::withoutSlash(odometry_->header.frame_id) : frame;
  try {
    if (frame != odom_frame)
      throw InputError(fmt::format("the local grid is in `{}`, the odometry in `{}`; both must be the same",
                                   frame, odom_frame));
    surroundings_.emplace(std::make_shared<const grid::OccupancyGrid>(toGrid(*message)));
    surroundings_stamp_s_ = message->header.stamp.toSec();
    tell("local grid", "");
  } catch (const InputError& error) {
    tell("local grid", error.what());
  }
}

void NavigatorInputs::handleMap(const nav_msgs::OccupancyGrid::ConstPtr& message) {
  try {
    map_ = std::make_shared<const grid::OccupancyGrid>(toGrid(*message));
    map_frame_of_message_ = ros_io::withoutSlash(message->header.frame_id);
    if (plan_frame_ == map_frame_of_message_) planner_.setMap(map_);
    tell("map", "");
  } catch (const InputError& error) {
    tell("map", error.what());
  }
}

void NavigatorInputs::choosePlanFrame() {
  if (!odometry_) return;
  const std::string odom_frame = ros_io::withoutSlash(odometry_->header.frame_id);
  const bool has_map = tf_buffer_.canTransform(params_.map_frame, odom_frame, ros::Time(0));
  const std::string frame = has_map ? params_.map_frame : odom_frame;
  if (frame == plan_frame_) return;
  plan_frame_ = frame;
  planner_.setMap(map_frame_of_message_ == frame ? map_ : nullptr);
}

FloorPose NavigatorInputs::inPlanFrame(const geometry_msgs::PoseStamped& pose) const {
  if (!odometry_)
    throw InputError(fmt::format("no odometry yet on {}; is its node running?", odometryTopic()));
  if (map_ && map_frame_of_message_ != plan_frame_)
    throw InputError(fmt::format(
        "there is a map in `{}`, but tf does not know where the robot is in it; is a localisation running?",
        map_frame_of_message_));
  const auto floor_pose = toFloorPose(pose.pose);
  if (!floor_pose)
    throw InputError("the goal has numbers that are not finite, or its orientation is no unit quaternion");
  const std::string frame = ros_io::withoutSlash(pose.header.frame_id);
  if (frame == plan_frame_) return *floor_pose;
  try {
    const auto transform = tf_buffer_.lookupTransform(plan_frame_, frame, ros::Time(0));
    const Eigen::Isometry2d T = planarPart(ros_io::toIsometry(transform.transform));
    FloorPose result{T * floor_pose->position_m, floor_pose->heading_rad};
    if (result.heading_rad) *result.heading_rad += std::atan2(T.linear()(1, 0), T.linear()(0, 0));
    return result;
  } catch (const tf2::TransformException& error) {
    throw InputError(fmt::format("the goal is in `{}`, from which nothing leads to `{}`: {}", frame,
                                 plan_frame_, error.what()));
  }
}

bool NavigatorInputs::lost(double now_s) {
  const std::string odom_frame = ros_io::withoutSlash(odometry_->header.frame_id);
  std::string problem;
  if (plan_frame_ == odom_frame) {
    T_plan_odom_.setIdentity();
  } else {
    try {
      const auto transform = tf_buffer_.lookupTransform(plan_frame_, odom_frame, ros::Time(0));
      T_plan_odom_ = planarPart(ros_io::toIsometry(transform.transform));
      const double age_s = now_s - transform.header.stamp.toSec();  // of a static one, the stamp is zero
      if (!transform.header.stamp.isZero() && age_s > params_.localisation_timeout_s)
        problem = fmt::format("{} -> {} is {:.1f} s old; is the localisation running?", plan_frame_,
                              odom_frame, age_s);
    } catch (const tf2::TransformException& error) {
      problem = error.what();
    }
  }
  if (vo_status_ && vo_status_->state == VoStatus::LOST)
    problem = "vo/status says LOST: " + vo_status_->reason;
  tell("localisation", problem);
  return !problem.empty();
}

std::optional<navigator::Situation> NavigatorInputs::situation(double now_s) {
  if (!odometry_) return std::nullopt;
  if (plan_frame_.empty()) choosePlanFrame();
  navigator::Situation situation;
  situation.now_s = now_s;
  situation.localisation_lost = lost(now_s);
  situation.T_map_odom = T_plan_odom_;
  situation.odometry_stamp_s = odometry_->header.stamp.toSec();
  situation.position_sigma_m = positionSigma(*odometry_);
  situation.state.T_world_base = onFloor(odometry_->pose.pose);
  const auto& twist = odometry_->twist.twist;
  situation.state.twist = {twist.linear.x, twist.linear.y, twist.angular.z};
  const auto& drive = params_.navigator.control.drive;
  if (drive.steered())
    steering_rad_ = control::steeringOf(situation.state.twist, drive.wheelbase_m, steering_rad_);
  situation.state.steering_rad = steering_rad_;
  if (surroundings_) {
    situation.surroundings = &*surroundings_;
    situation.surroundings_stamp_s = surroundings_stamp_s_;
    planner_.see(surroundings_->grid(), T_plan_odom_);
  }
  return situation;
}

void NavigatorInputs::tell(const std::string& input, const std::string& problem) {
  if (problem.empty())
    problems_.erase(input);
  else
    problems_[input] = problem;
}

}  // namespace stereo_nav::nodes
