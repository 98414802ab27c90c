// The navigator, whose base, odometry, local grid, map and localisation the test plays; started by
// navigator.test.
#include <actionlib/client/simple_action_client.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/GetPlan.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/transform_broadcaster.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "core/angles.h"
#include "stereo_nav/NavigatorStatus.h"
#include "stereo_nav/VoStatus.h"
#include "support/background_command.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

constexpr double kPeriod_s = 0.02;
constexpr double kCell_m = 0.05;
constexpr double kLongestWay_s = 120.0;  ///< more than any way takes

/// The wall of the world, which is the map: a gap is left at its upper end.
bool isWall(double x_m, double y_m) {
  return x_m > 2.0 && x_m < 2.2 && y_m < 0.5;
}

geometry_msgs::Pose poseAt(double x_m, double y_m, double heading_rad) {
  geometry_msgs::Pose pose;
  pose.position.x = x_m;
  pose.position.y = y_m;
  pose.orientation.z = std::sin(0.5 * heading_rad);
  pose.orientation.w = std::cos(0.5 * heading_rad);
  return pose;
}

geometry_msgs::PoseStamped inMap(double x_m, double y_m, double heading_rad) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "map";
  pose.pose = poseAt(x_m, y_m, heading_rad);
  return pose;
}

/// A base that moves at once as it is told. `odom` lies in the map as T_map_odom says.
class PlayedBase {
 public:
  PlayedBase() {
    T_map_odom_.translation() = Eigen::Vector2d(0.5, -0.4);
    T_map_odom_.rotate(0.6);
    odometry_ = handle_.advertise<nav_msgs::Odometry>("odom", 10);
    obstacles_ = handle_.advertise<nav_msgs::OccupancyGrid>("obstacles", 10);
    map_ = handle_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
    vo_status_ = handle_.advertise<VoStatus>("vo/status", 10);
    subscribers_ = {handle_.subscribe<geometry_msgs::Twist>(
                        "cmd_vel_auto", 1, [this](const geometry_msgs::Twist::ConstPtr& m) { command = *m; }),
                    handle_.subscribe<NavigatorStatus>(
                        "navigator/status", 10, [this](const NavigatorStatus::ConstPtr& m) { status = *m; }),
                    handle_.subscribe<nav_msgs::Path>(
                        "plan", 10, [this](const nav_msgs::Path::ConstPtr& m) { plan = *m; })};
    map_.publish(gridOf("map", {-2.0, -3.0}, 160, 120, Eigen::Isometry2d::Identity()));
    timer_ = handle_.createTimer(ros::Duration(kPeriod_s), [this](const ros::TimerEvent&) { step(); });
  }

  /// Distance from a place of the map.
  double distanceTo(double x_m, double y_m) const {
    return (T_map_base_.translation() - Eigen::Vector2d(x_m, y_m)).norm();
  }
  double heading_rad() const { return std::atan2(T_map_base_.linear()(1, 0), T_map_base_.linear()(0, 0)); }
  bool stands() const {
    return command.linear.x == 0.0 && command.linear.y == 0.0 && command.angular.z == 0.0;
  }
  bool drives() const { return command.linear.x > 0.1; }
  bool says(const std::string& text) const { return status.text.find(text) != std::string::npos; }
  void tellVoState(std::uint8_t state) {
    VoStatus message;
    message.state = state;
    vo_status_.publish(message);
  }

  geometry_msgs::Twist command;
  NavigatorStatus status;
  nav_msgs::Path plan;
  bool odometry_runs = true;
  ros::WallTime last_odometry;
  bool touched = false;  ///< a disc of the base's half width and the wall, ever

 private:
  void step() {
    Eigen::Isometry2d motion = Eigen::Isometry2d::Identity();
    motion.rotate(0.5 * kPeriod_s * command.angular.z);
    motion.translate(kPeriod_s * Eigen::Vector2d(command.linear.x, command.linear.y));
    motion.rotate(0.5 * kPeriod_s * command.angular.z);
    T_map_base_ = T_map_base_ * motion;
    for (double angle = 0.0; angle < 2.0 * kPi; angle += 0.1) {
      const Eigen::Vector2d p = T_map_base_ * Eigen::Vector2d(0.2 * std::cos(angle), 0.2 * std::sin(angle));
      touched = touched || isWall(p.x(), p.y());
    }
    const ros::Time now = ros::Time::now();
    sendTransform(now);
    if (odometry_runs) sendOdometry(now);
    if (++steps_ % 4 == 0) sendObstacles(now);
  }

  void sendTransform(const ros::Time& now) {
    geometry_msgs::TransformStamped message;
    message.header.stamp = now;
    message.header.frame_id = "map";
    message.child_frame_id = "odom";
    message.transform.translation.x = T_map_odom_.translation().x();
    message.transform.translation.y = T_map_odom_.translation().y();
    message.transform.rotation.z = std::sin(0.3);
    message.transform.rotation.w = std::cos(0.3);
    broadcaster_.sendTransform(message);
  }

  void sendOdometry(const ros::Time& now) {
    const Eigen::Isometry2d T_odom_base = T_map_odom_.inverse() * T_map_base_;
    nav_msgs::Odometry message;
    message.header.stamp = now;
    message.header.frame_id = "odom";
    message.child_frame_id = "base_link";
    message.pose.pose = poseAt(T_odom_base.translation().x(), T_odom_base.translation().y(),
                               std::atan2(T_odom_base.linear()(1, 0), T_odom_base.linear()(0, 0)));
    message.twist.twist = command;
    odometry_.publish(message);
    last_odometry = ros::WallTime::now();
  }

  void sendObstacles(const ros::Time& now) {
    const Eigen::Vector2d at = (T_map_odom_.inverse() * T_map_base_).translation();
    auto message = gridOf("odom", at - Eigen::Vector2d(3.0, 3.0), 120, 120, T_map_odom_);
    message.header.stamp = now;
    obstacles_.publish(message);
  }

  static nav_msgs::OccupancyGrid gridOf(const std::string& frame, const Eigen::Vector2d& origin,
                                        unsigned width, unsigned height,
                                        const Eigen::Isometry2d& T_map_frame) {
    nav_msgs::OccupancyGrid grid;
    grid.header.frame_id = frame;
    grid.info.resolution = static_cast<float>(kCell_m);
    grid.info.width = width;
    grid.info.height = height;
    grid.info.origin = poseAt(origin.x(), origin.y(), 0.0);
    for (unsigned y = 0; y < height; ++y) {
      for (unsigned x = 0; x < width; ++x) {
        const Eigen::Vector2d p = T_map_frame * (origin + kCell_m * Eigen::Vector2d(x + 0.5, y + 0.5));
        grid.data.push_back(isWall(p.x(), p.y()) ? 100 : 0);
      }
    }
    return grid;
  }

  ros::NodeHandle handle_;
  Eigen::Isometry2d T_map_odom_ = Eigen::Isometry2d::Identity(), T_map_base_ = Eigen::Isometry2d::Identity();
  ros::Publisher odometry_, obstacles_, map_, vo_status_;
  std::vector<ros::Subscriber> subscribers_;
  tf2_ros::TransformBroadcaster broadcaster_;
  int steps_ = 0;
  ros::Timer timer_;
};

/// One base for all tests: each begins where the one before it has ended.
class NavigatorNode : public testing::Test {
 protected:
  using Client = actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction>;

  static void SetUpTestSuite() { base_ = std::make_unique<PlayedBase>(); }
  static void TearDownTestSuite() { base_.reset(); }
  void SetUp() override {
    ASSERT_TRUE(spinUntil([this] { return client_.isServerConnected() && !base_->status.text.empty(); }));
    ASSERT_TRUE(spinUntil([this] { return frameIsKnown(); }));
  }
  void TearDown() override { EXPECT_FALSE(base_->touched); }

  /// Whether the node has odometry, map and tf: it can plan.
  bool frameIsKnown() {
    nav_msgs::GetPlan plan;
    plan.request.goal = inMap(1.0, 0.0, 0.0);
    return ros::service::call("make_plan", plan) && plan.response.plan.header.frame_id == "map" &&
           !plan.response.plan.poses.empty();
  }
  void send(const geometry_msgs::PoseStamped& pose) {
    move_base_msgs::MoveBaseGoal goal;
    goal.target_pose = pose;
    client_.sendGoal(goal);
  }
  bool isDone() const { return client_.getState().isDone(); }
  bool has(std::uint8_t mode) const { return base_->status.mode == mode; }

  static std::unique_ptr<PlayedBase> base_;
  ros::NodeHandle handle_;
  Client client_{"move_base", false};
};
std::unique_ptr<PlayedBase> NavigatorNode::base_;

TEST_F(NavigatorNode, AnActionlibClientOfMoveBaseGetsTheRobotAroundAWallToItsGoal) {
  send(inMap(4.0, -1.0, -0.5 * kPi));
  ASSERT_TRUE(spinUntil([this] { return isDone(); }, kLongestWay_s)) << base_->status.text;
  EXPECT_EQ(client_.getState(), actionlib::SimpleClientGoalState::SUCCEEDED) << client_.getState().getText();
  EXPECT_LT(base_->distanceTo(4.0, -1.0), 0.05);
  EXPECT_NEAR(base_->heading_rad(), -0.5 * kPi, 3.0 * kRadPerDeg);
  EXPECT_EQ(base_->plan.header.frame_id, "map");
  EXPECT_GT(base_->plan.poses.size(), 2U) << "it leads around the wall";
  EXPECT_TRUE(spinUntil([this] { return base_->stands() && has(NavigatorStatus::ARRIVED); }));
}

TEST_F(NavigatorNode, TheGoalOfRvizIsReached) {
  ros::Publisher publisher = handle_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1);
  ASSERT_TRUE(spinUntil([&] { return publisher.getNumSubscribers() > 0; }));
  publisher.publish(inMap(4.5, 1.0, 0.0));
  ASSERT_TRUE(spinUntil([this] { return has(NavigatorStatus::DRIVING); })) << base_->status.text;
  EXPECT_TRUE(spinUntil([this] { return has(NavigatorStatus::ARRIVED); }, kLongestWay_s))
      << base_->status.text;
  EXPECT_LT(base_->distanceTo(4.5, 1.0), 0.05);
}

TEST_F(NavigatorNode, AGivenPathIsFollowedAlsoFromAFileAndAnEmptyOneStops) {
  ros::Publisher publisher = handle_.advertise<nav_msgs::Path>("navigator/path", 1);
  ASSERT_TRUE(spinUntil([&] { return publisher.getNumSubscribers() > 0; }));
  nav_msgs::Path path;
  path.header.frame_id = "map";
  for (const double x_m : {4.5, 4.0, 3.5, 3.0}) path.poses.push_back(inMap(x_m, 1.5, kPi));
  publisher.publish(path);
  ASSERT_TRUE(spinUntil([this] { return base_->drives(); }, kLongestWay_s)) << base_->status.text;
  publisher.publish(nav_msgs::Path());
  ASSERT_TRUE(spinUntil([this] { return base_->stands() && has(NavigatorStatus::IDLE); }));

  const std::string file = testing::TempDir() + "navigator_test_path.csv";
  std::ofstream(file) << "x_m,y_m\n4.5,1.5\n4.0,1.5\n3.5,1.5\n3.0,1.5\n";
  BackgroundCommand sender("exec " SEND_PATH " _file:=" + file + " _frame:=map");
  EXPECT_TRUE(spinUntil([this] { return has(NavigatorStatus::ARRIVED); }, kLongestWay_s))
      << base_->status.text;
  EXPECT_EQ(sender.waitFor(kLongWait_s), 0) << sender.output();
  EXPECT_LT(base_->distanceTo(3.0, 1.5), 0.05);
}

TEST_F(NavigatorNode, StopsWithinThreeTenthsOfASecondWhenTheOdometryIsSilentAndGoesOn) {
  send(inMap(5.0, 1.5, 0.0));
  ASSERT_TRUE(spinUntil([this] { return base_->drives(); }, kLongestWay_s)) << base_->status.text;
  base_->odometry_runs = false;
  ASSERT_TRUE(spinUntil([this] { return base_->stands(); }, kLongWait_s, 0.001));
  EXPECT_LT((ros::WallTime::now() - base_->last_odometry).toSec(), 0.3);
  EXPECT_TRUE(spinUntil([this] { return base_->says("no odometry for"); })) << base_->status.text;
  base_->odometry_runs = true;
  ASSERT_TRUE(spinUntil([this] { return base_->drives(); }, kLongestWay_s)) << base_->status.text;

  base_->tellVoState(VoStatus::LOST);
  EXPECT_TRUE(spinUntil([this] { return base_->stands() && base_->says("the localisation is lost"); }));
  base_->tellVoState(VoStatus::TRACKING);
  ASSERT_TRUE(spinUntil([this] { return isDone(); }, kLongestWay_s)) << base_->status.text;
  EXPECT_EQ(client_.getState(), actionlib::SimpleClientGoalState::SUCCEEDED) << client_.getState().getText();
}

TEST_F(NavigatorNode, AGoalThatCannotBeReachedIsAbortedWithItsReason) {
  send(inMap(2.1, -1.0, 0.0));  // inside the wall
  ASSERT_TRUE(spinUntil([this] { return isDone(); }, kLongestWay_s)) << base_->status.text;
  EXPECT_EQ(client_.getState(), actionlib::SimpleClientGoalState::ABORTED);
  EXPECT_NE(client_.getState().getText().find("the robot does not fit at the goal"), std::string::npos)
      << client_.getState().getText();
  EXPECT_TRUE(spinUntil([this] { return base_->stands() && has(NavigatorStatus::FAILED); }));
}

TEST_F(NavigatorNode, AGoalInAnUnknownFrameIsRefusedAndACancelledOneStops) {
  geometry_msgs::PoseStamped pose = inMap(4.0, 1.0, 0.0);
  pose.header.frame_id = "moon";
  send(pose);
  ASSERT_TRUE(spinUntil([this] { return isDone(); }));
  EXPECT_EQ(client_.getState(), actionlib::SimpleClientGoalState::ABORTED);
  EXPECT_NE(client_.getState().getText().find("the goal is in `moon`"), std::string::npos)
      << client_.getState().getText();

  std_srvs::Empty nothing;
  EXPECT_TRUE(ros::service::call("clear_costmaps", nothing));
  send(inMap(4.0, -1.5, 0.0));
  ASSERT_TRUE(spinUntil([this] { return base_->drives(); }, kLongestWay_s)) << base_->status.text;
  client_.cancelGoal();
  ASSERT_TRUE(spinUntil([this] { return isDone(); }));
  EXPECT_EQ(client_.getState(), actionlib::SimpleClientGoalState::PREEMPTED);
  EXPECT_TRUE(spinUntil([this] { return base_->stands(); }));
}

}  // namespace
}  // namespace stereo_nav::test
