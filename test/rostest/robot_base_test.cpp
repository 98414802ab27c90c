// robot.launch with a rig file that has a base with a servo, on an emulated one. Started by robot_base.test.
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/Float64.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/transform_listener.h>

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "rostest/diagnostics_probe.h"
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

/// A point that a sensor sees, in base_link by the frame that its message names.
std::optional<Eigen::Vector3d> inBase(const tf2_ros::Buffer& buffer, const std::string& frame, double x_m) {
  const auto T_base_sensor = transform(buffer, frame);
  if (!T_base_sensor) return std::nullopt;
  return *T_base_sensor * Eigen::Vector3d(x_m, 0.0, 0.0);
}

TEST(RobotBase, LaserScannerAndRangeFindersAreWhereTheRigFileSays) {
  ros::NodeHandle handle;
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  sensor_msgs::LaserScan scan;
  const ros::Subscriber scans = handle.subscribe<sensor_msgs::LaserScan>(
      "scan", 10, [&](const sensor_msgs::LaserScan::ConstPtr& message) { scan = *message; });
  std::map<std::string, sensor_msgs::Range> ranges;
  std::vector<ros::Subscriber> subscribers;
  for (const std::string name : {"left", "front"})
    subscribers.push_back(handle.subscribe<sensor_msgs::Range>(
        "range/" + name, 10,
        [&ranges, name](const sensor_msgs::Range::ConstPtr& message) { ranges[name] = *message; }));
  EXPECT_TRUE(spinUntil([&] { return scan.ranges.size() == 90 && ranges.size() == 2; })) << ranges.size();
  // The scanner looks backwards, the one range finder to the left, that of the base forwards.
  const std::vector<std::tuple<std::string, double, Eigen::Vector3d>> seen = {
      {scan.header.frame_id, 1.0, {-1.0, 0.0, 0.4}},
      {ranges["left"].header.frame_id, ranges["left"].range, {0.0, 1.7, 0.0}},
      {ranges["front"].header.frame_id, ranges["front"].range, {2.2, 0.0, 0.1}}};
  for (const auto& [frame, distance_m, expected] : seen) {
    EXPECT_TRUE(spinUntil([&, &frame = frame] { return transform(buffer, frame).has_value(); })) << frame;
    const auto point = inBase(buffer, frame, distance_m);
    ASSERT_TRUE(point) << frame;
    EXPECT_TRUE(point->isApprox(expected, 1e-6)) << frame << " " << point->transpose();
  }
}

TEST(RobotBase, EachPartHasItsGroupOfDiagnostics) {
  DiagnosticsProbe groups("/diagnostics_agg");
  for (const std::string state :
       {"Base/base_bridge: base", "Base/cmd_vel_mux: cmd_vel", "Laser/laser_bridge: laser",
        "Ranges/range_bridge: range left", "Odometry/wheel_odometry: wheel odometry",
        "Mounting/rig_transforms: mounting", "Recording/recorder: recording"})
    EXPECT_TRUE(spinUntil([&] { return groups.has("/stereo_nav/" + state); })) << state << "\n"
                                                                               << groups.names();
  for (const std::string part : {"Base", "Laser", "Ranges"})
    EXPECT_TRUE(spinUntil([&] { return groups.levelOf("/stereo_nav/" + part) == 0; })) << part;
}

/// The recorder has the topics of everything that the rig file names.
TEST(RobotBase, AllThatTheBaseSendsIsRecorded) {
  std::set<std::string> recorded;
  EXPECT_TRUE(spinUntil([&] {
    XmlRpc::XmlRpcValue request, response, payload;
    request[0] = ros::this_node::getName();
    if (!ros::master::execute("getSystemState", request, response, payload, false)) return false;
    recorded.clear();
    for (int i = 0; i < payload[1].size(); ++i) {
      for (int j = 0; j < payload[1][i][1].size(); ++j) {
        const std::string topic = payload[1][i][0], node = payload[1][i][1][j];
        if (node == "/recorder") recorded.insert(topic);
      }
    }
    return recorded.count("/range/left") != 0;
  }));
  for (const std::string topic : {"/scan", "/wheel_ticks", "/joint_states", "/battery", "/range/front",
                                  "/joints/camera_tilt", "/cmd_vel", "/tf_static"})
    EXPECT_EQ(recorded.count(topic), 1U) << topic;
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
      {"range_front", "/tf_static of /rig_transforms"},
      {"scanner", "/tf_static of /rig_transforms"},
      {"range_left", "/tf_static of /rig_transforms"}};
  EXPECT_TRUE(spinUntil([&] { return publishers.size() >= expected.size(); }));
  for (const auto& [frame, publisher] : expected)
    EXPECT_EQ(publishers[frame], std::set<std::string>{publisher}) << frame;
}

}  // namespace
}  // namespace stereo_nav::test
