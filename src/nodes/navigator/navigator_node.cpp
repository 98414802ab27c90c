#include "nodes/navigator/navigator_node.h"

#include <fmt/format.h>
#include <geometry_msgs/Twist.h>

#include "core/planar_motion.h"
#include "ros/parameter_server.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::nodes {
namespace {

using navigator::NavigatorMode;

constexpr double kStatusPeriod_s = 1.0;

// The message has the modes of the navigator.
static_assert(static_cast<int>(NavigatorMode::kIdle) == NavigatorStatus::IDLE);
static_assert(static_cast<int>(NavigatorMode::kFailed) == NavigatorStatus::FAILED);

NavigatorNodeParams readNavigatorParams(const ros::NodeHandle& private_handle) {
  NavigatorNodeParams params;
  ros_io::readParameters({ros_io::fileSource(private_handle, "config"),
                          ros_io::serverSource(private_handle, {"diagnostic_period"})},
                         params);
  params.shareOutline();
  return params;
}

}  // namespace

NavigatorNode::NavigatorNode(ros::NodeHandle handle, ros::NodeHandle private_handle, const std::string& name)
    : name_(name),
      params_(readNavigatorParams(private_handle)),
      planner_(params_.planner),
      navigator_(params_.navigator, planner_),
      inputs_(handle, params_, planner_),
      server_(handle, "move_base", false),
      updater_(handle, private_handle, name_) {
  velocity_ = handle.advertise<geometry_msgs::Twist>(ros_io::topics::kCmdVelAuto, 1);
  plan_ = handle.advertise<nav_msgs::Path>("plan", 1, true);
  status_publisher_ = handle.advertise<NavigatorStatus>("navigator/status", 10, true);
  action_goal_ = handle.advertise<move_base_msgs::MoveBaseActionGoal>("move_base/goal", 1);
  subscribers_ = {handle.subscribe("move_base_simple/goal", 1, &NavigatorNode::handleSimpleGoal, this),
                  handle.subscribe("navigator/path", 1, &NavigatorNode::handlePath, this)};
  services_ = {handle.advertiseService("make_plan", &NavigatorNode::handleMakePlan, this),
               handle.advertiseService("clear_costmaps", &NavigatorNode::handleClear, this)};
  updater_.setHardwareID("none");
  updater_.add("navigator", this, &NavigatorNode::fillStatus);
  server_.registerGoalCallback([this] { handleGoal(); });
  server_.registerPreemptCallback([this] { handlePreemption(); });
  server_.start();
  timer_ = handle.createTimer(ros::Duration(params_.navigator.control.period_s), &NavigatorNode::handleTimer,
                              this);
}

bool NavigatorNode::hasGoal() const {
  return navigator_.mode() == NavigatorMode::kDriving || navigator_.mode() == NavigatorMode::kRecovering;
}

void NavigatorNode::handleGoal() {
  const auto goal = server_.acceptNewGoal();
  with_action_ = true;
  try {
    inputs_.choosePlanFrame();
    start(inputs_.inPlanFrame(goal->target_pose), {});
  } catch (const InputError& error) {
    refuse(error.what());
  }
}

void NavigatorNode::handlePreemption() {
  if (server_.isNewGoalAvailable()) return;  // which takes its place
  stop();
  server_.setPreempted(move_base_msgs::MoveBaseResult(), "the goal was given up");
  with_action_ = false;
}

void NavigatorNode::handleSimpleGoal(const geometry_msgs::PoseStamped::ConstPtr& message) {
  move_base_msgs::MoveBaseActionGoal goal;
  goal.header.stamp = ros::Time::now();
  goal.goal.target_pose = *message;
  action_goal_.publish(goal);  // the same way as all others; move_base does so, too
}

void NavigatorNode::handlePath(const nav_msgs::Path::ConstPtr& message) {
  if (with_action_) server_.setPreempted(move_base_msgs::MoveBaseResult(), "a path has taken its place");
  with_action_ = false;
  if (message->poses.empty()) {
    stop();
    return;
  }
  try {
    inputs_.choosePlanFrame();
    std::vector<Eigen::Vector2d> points;
    FloorPose last{Eigen::Vector2d::Zero(), std::nullopt};
    for (geometry_msgs::PoseStamped pose : message->poses) {
      pose.header = message->header;
      last = inputs_.inPlanFrame(pose);
      points.push_back(last.position_m);
    }
    start(last, points);
  } catch (const InputError& error) {
    refuse(error.what());
  }
}

void NavigatorNode::start(const FloorPose& goal, const std::vector<Eigen::Vector2d>& path) {
  words_.clear();
  planner_.keepTo(path);
  navigator_.setGoal({goal.position_m, goal.heading_rad});
  was_active_ = true;
  ROS_INFO_STREAM(name_ << ": " << (path.empty() ? "goal" : "path to")
                        << fmt::format(" ({:.2f}, {:.2f}) in {}", goal.position_m.x(), goal.position_m.y(),
                                       inputs_.planFrame()));
}

void NavigatorNode::stop() {
  if (!hasGoal()) return;
  navigator_.cancel();
  was_active_ = false;
  publish(navigator::Twist::Zero());
}

void NavigatorNode::refuse(const std::string& why) {
  stop();
  was_active_ = false;
  ++failed_;
  words_ = "the goal is refused: " + why;
  ROS_ERROR_STREAM(name_ << ": " << words_);
  if (with_action_) server_.setAborted(move_base_msgs::MoveBaseResult(), words_);
  with_action_ = false;
}

bool NavigatorNode::handleMakePlan(nav_msgs::GetPlan::Request& request,
                                   nav_msgs::GetPlan::Response& response) {
  const auto situation = inputs_.situation(ros::Time::now().toSec());
  if (!hasGoal()) inputs_.choosePlanFrame();
  response.plan.header.frame_id = inputs_.planFrame();
  response.plan.header.stamp = ros::Time::now();
  try {
    navigation::PlanarPose start;
    if (!request.start.header.frame_id.empty()) {
      const FloorPose pose = inputs_.inPlanFrame(request.start);
      start = {pose.position_m, pose.heading_rad.value_or(0.0)};
    } else if (situation) {
      const Eigen::Isometry2d T_plan_base = situation->T_map_odom * situation->state.T_world_base;
      start = {T_plan_base.translation(), yawOf(T_plan_base)};
    }
    const FloorPose goal = inputs_.inPlanFrame(request.goal);
    const navigation::Plan plan = planner_.between(start, {goal.position_m, goal.heading_rad});
    if (!plan.text.empty()) ROS_WARN_STREAM(name_ << ": make_plan: " << plan.text);
    for (const auto& pose : plan.poses) {
      geometry_msgs::PoseStamped stamped;
      stamped.header = response.plan.header;
      stamped.pose = toMessage(pose);
      response.plan.poses.push_back(stamped);
    }
  } catch (const InputError& error) {
    ROS_ERROR_STREAM(name_ << ": make_plan: " << error.what());
  }
  return true;
}

bool NavigatorNode::handleClear(std_srvs::Empty::Request& /*request*/,
                                std_srvs::Empty::Response& /*response*/) {
  planner_.clear();
  return true;
}

void NavigatorNode::handleTimer(const ros::TimerEvent& /*event*/) {
  const double now_s = ros::Time::now().toSec();
  if (const auto situation = inputs_.situation(now_s)) {
    const navigator::Twist twist = navigator_.update(*situation);
    if (was_active_) publish(twist);
    if (was_active_) publishFeedback(*situation);
  }
  if (planner_.plans() != plans_) publishPlan();
  if (was_active_ && !hasGoal()) reportEnd();
  publishStatus(now_s);
  updater_.update();
}

void NavigatorNode::reportEnd() {
  was_active_ = false;
  publish(navigator::Twist::Zero());
  const bool reached = navigator_.mode() == NavigatorMode::kArrived;
  ++(reached ? reached_ : failed_);
  if (reached)
    ROS_INFO_STREAM(name_ << ": " << navigator_.words());
  else
    ROS_ERROR_STREAM(name_ << ": " << navigator_.words());
  if (!with_action_) return;
  with_action_ = false;
  if (reached)
    server_.setSucceeded(move_base_msgs::MoveBaseResult(), navigator_.words());
  else
    server_.setAborted(move_base_msgs::MoveBaseResult(), navigator_.words());
}

void NavigatorNode::publish(const navigator::Twist& twist) {
  geometry_msgs::Twist message;
  message.linear.x = twist.x();
  message.linear.y = twist.y();
  message.angular.z = twist.z();
  velocity_.publish(message);
}

void NavigatorNode::publishPlan() {
  plans_ = planner_.plans();
  if (!planner_.note().empty()) ROS_WARN_STREAM(name_ << ": " << planner_.note());
  plan_.publish(toPath(planner_.route().points_map, inputs_.planFrame(), ros::Time::now()));
}

void NavigatorNode::publishFeedback(const navigator::Situation& situation) {
  if (!with_action_ || !server_.isActive()) return;
  const Eigen::Isometry2d T_plan_base = situation.T_map_odom * situation.state.T_world_base;
  move_base_msgs::MoveBaseFeedback feedback;
  feedback.base_position.header.frame_id = inputs_.planFrame();
  feedback.base_position.header.stamp = ros::Time(situation.odometry_stamp_s);
  feedback.base_position.pose = toMessage({T_plan_base.translation(), yawOf(T_plan_base)});
  server_.publishFeedback(feedback);
}

void NavigatorNode::publishStatus(double now_s) {
  const std::string text = words_.empty() ? navigator_.words() : words_;
  const std::uint8_t mode =
      words_.empty() ? static_cast<std::uint8_t>(navigator_.mode()) : std::uint8_t{NavigatorStatus::FAILED};
  if (text == status_.text && mode == status_.mode && now_s - status_s_ < kStatusPeriod_s) return;
  status_s_ = now_s;
  status_.header.frame_id = inputs_.planFrame();
  status_.header.stamp = ros::Time(now_s);
  status_.mode = mode;
  status_.text = text;
  status_.goals_reached = reached_;
  status_.goals_failed = failed_;
  status_publisher_.publish(status_);
}

void NavigatorNode::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  status.summary(Level::OK, status_.text);
  if (navigator_.mode() == NavigatorMode::kRecovering) status.summary(Level::WARN, status_.text);
  for (const auto& problem : inputs_.problems())
    status.mergeSummary(hasGoal() ? Level::ERROR : Level::WARN, problem.second);
  status.add("goals reached", reached_);
  status.add("goals failed", failed_);
  status.add("plans made", planner_.plans());
  status.add("frame of goals", inputs_.planFrame());
}

}  // namespace stereo_nav::nodes
