// cmd_vel_mux and teleop, started by cmd_vel.test.
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "sensors/serial/emulation/pseudo_terminal.h"
#include "support/background_command.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

geometry_msgs::Twist forward(double speed_m_per_s) {
  geometry_msgs::Twist twist;
  twist.linear.x = speed_m_per_s;
  return twist;
}

/// Sends on the three topics and listens to what comes out.
class CmdVel : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* topic : {"cmd_vel_stop", "cmd_vel_manual", "cmd_vel_auto"})
      senders_.push_back(handle_.advertise<geometry_msgs::Twist>(topic, 1));
    output_ = handle_.subscribe<geometry_msgs::Twist>(
        "cmd_vel", 1000, [this](const geometry_msgs::Twist::ConstPtr& m) { passed_.push_back(*m); });
    ASSERT_TRUE(spinUntil([this] {
      return output_.getNumPublishers() > 0 && senders_[0].getNumSubscribers() > 0 &&
             senders_[1].getNumSubscribers() > 0 && senders_[2].getNumSubscribers() > 0;
    }));
    ASSERT_TRUE(spinUntil([this] { return isSilent(); }));
    passed_.clear();
  }

  /// Whether nothing has passed for longer than any time-out.
  bool isSilent() {
    if (passed_.size() != seen_) {
      seen_ = passed_.size();
      silent_since_ = ros::WallTime::now();
    }
    return (ros::WallTime::now() - silent_since_).toSec() > 0.7;
  }

  /// Publishes the speeds on these topics until the condition holds; a negative one is not sent.
  template <class Condition>
  bool sendUntil(double stop, double manual, double automatic, Condition&& condition) {
    return spinUntil(
        [&] {
          if (stop >= 0.0) senders_[0].publish(forward(stop));
          if (manual >= 0.0) senders_[1].publish(forward(manual));
          if (automatic >= 0.0) senders_[2].publish(forward(automatic));
          return condition();
        },
        kLongWait_s, 0.05);
  }
  bool last(double speed_m_per_s) const {
    return !passed_.empty() && std::abs(passed_.back().linear.x - speed_m_per_s) < 1e-9;
  }

  ros::NodeHandle handle_;
  std::vector<ros::Publisher> senders_;
  ros::Subscriber output_;
  std::vector<geometry_msgs::Twist> passed_;
  std::size_t seen_ = 0;
  ros::WallTime silent_since_ = ros::WallTime::now();
};

TEST_F(CmdVel, TheHigherRankHasTheWord) {
  ASSERT_TRUE(sendUntil(-1, -1, 0.3, [&] { return last(0.3); }));
  ASSERT_TRUE(sendUntil(-1, 0.2, 0.3, [&] { return last(0.2); }));
  passed_.clear();
  ASSERT_TRUE(sendUntil(-1, 0.2, 0.3, [&] { return passed_.size() > 10; }));
  for (const auto& twist : passed_) EXPECT_NEAR(twist.linear.x, 0.2, 1e-9);
  ASSERT_TRUE(sendUntil(0.9, 0.2, 0.3, [&] { return last(0.0); })) << "cmd_vel_stop stops, whatever it holds";
  passed_.clear();
  ASSERT_TRUE(sendUntil(0.9, 0.2, 0.3, [&] { return passed_.size() > 10; }));
  for (const auto& twist : passed_) EXPECT_EQ(twist.linear.x, 0.0);
  EXPECT_TRUE(sendUntil(-1, -1, 0.3, [&] { return last(0.3); })) << "when the others have fallen silent";
}

TEST_F(CmdVel, ASilenceEndsInOneZeroVelocity) {
  ASSERT_TRUE(sendUntil(-1, -1, 0.3, [&] { return last(0.3); }));
  ASSERT_TRUE(spinUntil([&] { return last(0.0); }));
  passed_.clear();
  ASSERT_TRUE(spinUntil([&] { return isSilent(); }));
  EXPECT_TRUE(passed_.empty());
}

TEST_F(CmdVel, AHeldKeyDrivesAndOneThatIsLetGoStops) {
  serial::PseudoTerminal terminal;
  const BackgroundCommand teleop("exec " TELEOP " <" + terminal.path());
  ASSERT_TRUE(teleop.waitForOutput("Hold a key to drive"));
  const auto hold = [&](char key, const auto& condition) {
    return spinUntil(
        [&] {
          terminal.write({static_cast<std::uint8_t>(key)});
          return condition();
        },
        kLongWait_s, 0.05);
  };
  ASSERT_TRUE(hold('i', [&] { return last(0.5); }));
  ASSERT_TRUE(spinUntil([&] { return last(0.0); })) << "the key is let go";
  // Field-centric with the base turned left: forward in the field is to its right.
  const ros::Publisher odometry = handle_.advertise<nav_msgs::Odometry>("odom", 1);
  nav_msgs::Odometry odom;
  odom.pose.pose.orientation.z = odom.pose.pose.orientation.w = std::sqrt(0.5);
  terminal.write({'f'});
  ASSERT_TRUE(teleop.waitForOutput("field-centric (odom)"));
  EXPECT_TRUE(hold('i', [&] {
    odometry.publish(odom);
    return !passed_.empty() && std::abs(passed_.back().linear.y + 0.5) < 1e-6;
  }));
  teleop.signal(SIGINT);
  EXPECT_TRUE(spinUntil([&] { return last(0.0) && std::abs(passed_.back().linear.y) < 1e-9; }));
}

TEST(CmdVelTeleop, WithoutATerminalItSaysWhatToDo) {
  BackgroundCommand teleop("exec " TELEOP " </dev/null");
  EXPECT_EQ(teleop.waitFor(kLongWait_s), 2);
  EXPECT_NE(teleop.output().find("start teleop in a terminal of its own"), std::string::npos)
      << teleop.output();
}

}  // namespace
}  // namespace stereo_nav::test
