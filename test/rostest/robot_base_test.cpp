// robot.launch with a rig file that has a base with a servo, on an emulated one. Started by robot_base.test.
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Float64.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

std::optional<Eigen::Isometry3d> transform(const tf2_ros::Buffer& buffer, const std::string& child) {
  try {
    return Eigen::Isometry3d(tf2::transformToEigen(buffer.lookupTransform("base_link", child, ros::Time(0))));
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

TEST(RobotBase, AVelocityBecomesOdometryOfTheWheels) {
  ros::NodeHandle handle;
  const ros::Publisher velocity = handle.advertise<geometry_msgs::Twist>("cmd_vel_manual", 1);
  double x_m = 0.0;
  const ros::Subscriber odometry = handle.subscribe<nav_msgs::Odometry>(
      "wheel/odom", 100, [&](const nav_msgs::Odometry::ConstPtr& m) { x_m = m->pose.pose.position.x; });
  geometry_msgs::Twist forward;
  forward.linear.x = 0.3;
  EXPECT_TRUE(spinUntil(
      [&] {
        velocity.publish(forward);
        return x_m > 0.3;
      },
      kLongWait_s, 0.05))
      << x_m;
}

TEST(RobotBase, TheLaserScansAndRangeFindersThatTheRigFileLacksRest) {
  ros::NodeHandle handle;
  std::size_t beams = 0;
  const ros::Subscriber scans = handle.subscribe<sensor_msgs::LaserScan>(
      "scan", 10, [&](const sensor_msgs::LaserScan::ConstPtr& scan) { beams = scan->ranges.size(); });
  EXPECT_TRUE(spinUntil([&] { return beams == 90; })) << beams;
  ros::V_string nodes;
  ASSERT_TRUE(ros::master::getNodes(nodes));
  EXPECT_NE(std::find(nodes.begin(), nodes.end(), "/range_bridge"), nodes.end())
      << "it rests, and does not end";
}

TEST(RobotBase, TheLaserTellsWhereTheBaseIs) {
  ros::NodeHandle handle;
  std::optional<nav_msgs::Odometry> odometry;
  const ros::Subscriber subscriber = handle.subscribe<nav_msgs::Odometry>(
      "laser/odom", 10, [&](const nav_msgs::Odometry::ConstPtr& message) { odometry = *message; });
  ASSERT_TRUE(spinUntil([&] { return odometry.has_value(); }));
  EXPECT_EQ(odometry->child_frame_id, "base_link");
}

TEST(RobotBase, TheCamerasTurnWithTheServoThatCarriesThem) {
  ros::NodeHandle handle;
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  const ros::Publisher tilt = handle.advertise<std_msgs::Float64>("joints/camera_tilt", 1);
  ASSERT_TRUE(spinUntil([&] { return transform(buffer, "camera_left_optical").has_value(); }));
  const Eigen::Isometry3d straight = *transform(buffer, "camera_left_optical");
  EXPECT_TRUE(straight.translation().isApprox(Eigen::Vector3d(0.1, 0.0, 0.3), 1e-6))
      << straight.translation();
  std_msgs::Float64 angle;
  angle.data = 0.5;
  // 5 cm above the axis: forward and down; the view turns down.
  const Eigen::Vector3d expected(0.1 + 0.05 * std::sin(0.5), 0.0, 0.25 + 0.05 * std::cos(0.5));
  EXPECT_TRUE(spinUntil([&] {
    tilt.publish(angle);
    const auto turned = transform(buffer, "camera_left_optical");
    return turned && turned->translation().isApprox(expected, 1e-4) &&
           std::abs(turned->linear()(2, 2) + std::sin(0.5)) < 1e-4;
  })) << transform(buffer, "camera_left_optical")->matrix();
}

/// Each frame has one publisher, and is either fixed or moving.
TEST(RobotBase, EachTransformHasOnePublisher) {
  ros::NodeHandle handle;
  std::map<std::string, std::set<std::string>> publishers;
  using Event = ros::MessageEvent<const tf2_msgs::TFMessage>;
  const auto listenTo = [&](const std::string& topic) {
    return handle.subscribe<tf2_msgs::TFMessage, const Event&>(
        topic, 100, [&publishers, topic](const Event& event) {
          for (const auto& t : event.getConstMessage()->transforms)
            publishers[t.child_frame_id].insert(topic + " of " + event.getPublisherName());
        });
  };
  const ros::Subscriber moving = listenTo("/tf"), fixed = listenTo("/tf_static");
  const std::map<std::string, std::string> expected = {
      {"left_wheel", "/tf of /robot_state_publisher"},
      {"right_wheel", "/tf of /robot_state_publisher"},
      {"camera_tilt_link", "/tf of /robot_state_publisher"},
      {"imu_link", "/tf_static of /rig_transforms"},
      {"camera_left_optical", "/tf_static of /rig_transforms"},
      {"laser_link", "/tf_static of /rig_transforms"},
      {"range_front", "/tf_static of /rig_transforms"}};
  EXPECT_TRUE(spinUntil([&] { return publishers.size() >= expected.size(); }));
  for (const auto& [frame, publisher] : expected)
    EXPECT_EQ(publishers[frame], std::set<std::string>{publisher}) << frame;
}

}  // namespace
}  // namespace stereo_nav::test
