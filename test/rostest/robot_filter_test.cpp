// robot.launch with odom_tf:=ekf_localization, started by robot_filter.test.
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <optional>
#include <set>
#include <string>

#include "rostest/graph_probe.h"
#include "support/command.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

TEST(RobotFilter, AloneSaysWhereTheRobotIs) {
  ros::NodeHandle handle;
  GraphProbe probe;
  std::set<std::string> publishers;
  const ros::Subscriber transforms =
      handle.subscribe<tf2_msgs::TFMessage, const ros::MessageEvent<const tf2_msgs::TFMessage>&>(
          "/tf", 100, [&publishers](const ros::MessageEvent<const tf2_msgs::TFMessage>& event) {
            for (const auto& transform : event.getMessage()->transforms)
              if (transform.child_frame_id == "base_link") publishers.insert(event.getPublisherName());
          });
  std::optional<nav_msgs::Odometry> filtered;
  const ros::Subscriber subscriber = handle.subscribe<nav_msgs::Odometry>(
      "odometry/filtered", 100,
      [&filtered](const nav_msgs::Odometry::ConstPtr& message) { filtered = *message; });
  // Until the robot has driven half a metre by the visual odometry, which goes on without tf.
  ASSERT_TRUE(spinUntil([&] {
    return filtered && !publishers.empty() && !probe.odometry.empty() &&
           distance(probe.odometry.front(), probe.odometry.back()) > 0.5;
  }));
  EXPECT_EQ(publishers, std::set<std::string>{"/ekf_localization"});
  EXPECT_LT(distance(*filtered, probe.odometry.back()), 0.2);
}

TEST(RobotFilter, AnUnknownPublisherOfTfIsRefusedByName) {
  const CommandResult refused =
      runCommand("roslaunch --nodes " STEREO_NAV_SOURCE_DIR "/launch/robot.launch odom_tf:=laser");
  EXPECT_NE(refused.status, 0);
  EXPECT_NE(refused.output.find("odom_tf must be one of these"), std::string::npos) << refused.output;
  EXPECT_NE(refused.output.find("'laser'"), std::string::npos) << refused.output;
}

}  // namespace
}  // namespace stereo_nav::test
