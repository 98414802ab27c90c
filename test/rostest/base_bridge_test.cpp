// base_bridge nodes on emulated bases, started by base_bridge.test.
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "rostest/diagnostics_probe.h"
#include "stereo_nav/WheelTicks.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

/// Distance of a pulse of base_rig.yaml.
constexpr double kPulse_m = 2.0 * M_PI * 0.05 / 1024.0;

/// One bridge's topics.
class Base {
 public:
  explicit Base(const std::string& name) : handle_(name), status_(name + "/base_bridge: base") {
    listen<WheelTicks>("wheel_ticks", ticks);
    listen<sensor_msgs::JointState>("joint_states", joints);
    velocity_ = handle_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  }

  template <class Message>
  void listen(const std::string& topic, std::vector<Message>& messages) {
    subscribers_.push_back(handle_.subscribe<Message>(
        topic, 10000,
        [&messages](const typename Message::ConstPtr& message) { messages.push_back(*message); }));
  }

  void drive(double x_m_per_s, double turn_rad_per_s = 0.0) {
    geometry_msgs::Twist twist;
    twist.linear.x = x_m_per_s;
    twist.angular.z = turn_rad_per_s;
    velocity_.publish(twist);
  }

  /// Sends a velocity at some 20 Hz until the condition holds.
  template <class Condition>
  bool driveUntil(double x_m_per_s, double turn_rad_per_s, Condition&& condition) {
    return spinUntil(
        [&] {
          drive(x_m_per_s, turn_rad_per_s);
          return condition();
        },
        kLongWait_s, 0.05);
  }

  ros::Publisher order(const std::string& topic) { return handle_.advertise<std_msgs::Float64>(topic, 1); }

  std_srvs::Trigger::Response call(const std::string& service) {
    std_srvs::Trigger trigger;
    EXPECT_TRUE(ros::service::waitForService(handle_.resolveName(service), ros::Duration(kLongWait_s)));
    EXPECT_TRUE(handle_.serviceClient<std_srvs::Trigger>(service).call(trigger));
    return trigger.response;
  }

  bool says(const std::string& text) const {
    return diagnostics_.says(status_, text) || diagnostics_.says("/" + status_, text);
  }
  std::string status() const { return diagnostics_.textOf(status_) + diagnostics_.textOf("/" + status_); }

  /// Whether the newest counters are the same as those half a second before.
  bool stands() const {
    if (ticks.empty()) return false;
    const ros::Time before = ticks.back().header.stamp - ros::Duration(0.5);
    const auto old = std::find_if(ticks.rbegin(), ticks.rend(),
                                  [&](const WheelTicks& t) { return t.header.stamp <= before; });
    return old != ticks.rend() && old->pulses == ticks.back().pulses;
  }
  double way_m(std::size_t wheel) const {
    return kPulse_m * static_cast<double>(ticks.back().pulses[wheel] - ticks.front().pulses[wheel]);
  }
  double jointAngle(const std::string& name) const {
    const auto& last = joints.back();
    const auto found = std::find(last.name.begin(), last.name.end(), name);
    return found == last.name.end() ? std::nan("")
                                    : last.position[static_cast<std::size_t>(found - last.name.begin())];
  }

  std::vector<WheelTicks> ticks;
  std::vector<sensor_msgs::JointState> joints;

 private:
  ros::NodeHandle handle_;
  std::string status_;
  DiagnosticsProbe diagnostics_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Publisher velocity_;
};

TEST(BaseBridge, DrivesAsCommandedSteersAndStopsWhenItsDriverFallsSilent) {
  Base base("clean");
  ASSERT_TRUE(spinUntil([&] { return base.ticks.size() > 10; }));
  EXPECT_EQ(base.ticks.back().names[1], "front_right");
  ASSERT_TRUE(base.driveUntil(0.4, 0.4, [&] { return base.way_m(2) > 0.5; }));
  // About a centre 1 m to the left: the rear wheels roll on 0.85 and 1.15 m, those in front steer there.
  EXPECT_NEAR(-base.way_m(3) / base.way_m(2), 1.15 / 0.85, 0.05) << "the encoder is reversed";
  EXPECT_NEAR(base.ticks.back().steering_rad[0], std::atan2(0.3, 0.85), 0.02);
  EXPECT_NEAR(base.ticks.back().steering_rad[1], std::atan2(0.3, 1.15), 0.02);
  EXPECT_NEAR(base.jointAngle("front_left_steering"), std::atan2(0.3, 0.85), 0.02);
  EXPECT_TRUE(spinUntil([&] { return base.stands(); }));
  EXPECT_TRUE(spinUntil([&] { return base.says("stops because cmd_vel fell silent: 1"); })) << base.status();
  for (std::size_t i = 1; i < base.ticks.size(); ++i)
    ASSERT_GT(base.ticks[i].header.stamp, base.ticks[i - 1].header.stamp);
}

TEST(BaseBridge, AStopHoldsUntilItIsReleased) {
  Base base("clean");
  ASSERT_TRUE(spinUntil([&] { return base.ticks.size() > 10; }));
  ASSERT_TRUE(base.driveUntil(0.3, 0.0, [&] { return base.way_m(2) > 0.1; }));
  const auto stopped = base.call("base/stop");
  EXPECT_TRUE(stopped.success) << stopped.message;
  EXPECT_TRUE(base.driveUntil(0.3, 0.0, [&] { return base.stands(); }));
  EXPECT_TRUE(
      base.driveUntil(0.3, 0.0, [&] { return base.says("cmd_vel is refused: the base is stopped"); }));
  const auto released = base.call("base/release");
  EXPECT_TRUE(released.success) << released.message;
  EXPECT_TRUE(spinUntil([&] { return base.stands(); })) << "no old velocity is taken up";
  const double before_m = base.way_m(2);
  EXPECT_TRUE(base.driveUntil(0.3, 0.0, [&] { return base.way_m(2) > before_m + 0.1; }));
}

TEST(BaseBridge, PublishesRangesBatterySwitchesServosAndActuators) {
  Base base("clean");
  std::vector<sensor_msgs::Range> front, rear;
  std::vector<sensor_msgs::BatteryState> battery;
  std::vector<std_msgs::Bool> bumper, start;
  std::vector<std_msgs::Float64> intake;
  base.listen("range/front", front);
  base.listen("range/rear", rear);
  base.listen("battery", battery);
  base.listen("switch/bumper", bumper);
  base.listen("switch/start", start);
  base.listen("actuators/intake/state", intake);
  const ros::Publisher tilt = base.order("joints/camera_tilt"), motor = base.order("actuators/intake");
  ASSERT_TRUE(spinUntil([&] {
    return !front.empty() && !rear.empty() && !battery.empty() && !bumper.empty() && !start.empty() &&
           !intake.empty();
  }));
  EXPECT_NEAR(front.back().range, 1.5, 1e-3);
  EXPECT_EQ(front.back().header.frame_id, "range_front");
  EXPECT_TRUE(std::isinf(rear.back().range) && rear.back().range > 0.0F) << "beyond its 1 m";
  EXPECT_NEAR(battery.back().voltage, 12.4, 1e-3);
  EXPECT_NEAR(battery.back().percentage, 1.4 / 1.6, 1e-3);
  EXPECT_FALSE(bumper.back().data);
  EXPECT_TRUE(start.back().data);
  std_msgs::Float64 angle, level;
  angle.data = 0.5;
  level.data = -0.25;
  EXPECT_TRUE(spinUntil([&] {
    tilt.publish(angle);
    motor.publish(level);
    return std::abs(base.jointAngle("camera_tilt") - 0.5) < 1e-6 && !intake.empty() &&
           std::abs(intake.back().data + 0.25) < 1e-9;
  }));
}

TEST(BaseBridge, DrivesOnADamagedLineAndCountsTheDamage) {
  Base base("damaged");
  ASSERT_TRUE(spinUntil([&] { return base.ticks.size() > 10; }));
  ASSERT_TRUE(base.driveUntil(0.3, 0.0, [&] { return base.way_m(2) > 1.0; }));
  EXPECT_NEAR(-base.way_m(3), base.way_m(2), 0.05);
  EXPECT_TRUE(spinUntil([&] { return base.says("bad frames: ") && !base.says("bad frames: 0"); }))
      << base.status();
  EXPECT_TRUE(spinUntil([&] {
    return base.says("commands damaged at the controller: ") &&
           !base.says("commands damaged at the controller: 0");
  })) << base.status();
  EXPECT_TRUE(spinUntil([&] { return base.stands(); }));
}

TEST(BaseBridge, FindsAControllerAgainUnderAnotherIndex) {
  Base base("replugged");
  ASSERT_TRUE(spinUntil([&] { return base.says("connections: 2"); })) << base.status();
  base.ticks.clear();
  ASSERT_TRUE(spinUntil([&] { return base.ticks.size() > 10; }));
  EXPECT_TRUE(base.driveUntil(0.3, 0.0, [&] { return base.way_m(2) > 0.1; }));
}

TEST(BaseBridge, WithoutTelemetryItSaysSoAndRefusesVelocities) {
  Base base("silent");
  EXPECT_TRUE(base.driveUntil(0.3, 0.0, [&] { return base.says("cmd_vel is refused: no telemetry"); }))
      << base.status();
  EXPECT_TRUE(spinUntil([&] { return base.says("no bytes for "); })) << base.status();
  const auto answer = base.call("base/stop");
  EXPECT_FALSE(answer.success);
  EXPECT_NE(answer.message.find("not confirmed"), std::string::npos) << answer.message;
}

TEST(BaseBridge, AnotherRobotsControllerIsNamed) {
  Base base("other");
  EXPECT_TRUE(base.driveUntil(0.3, 0.0, [&] { return base.says("is that of another robot"); }))
      << base.status();
  EXPECT_TRUE(base.ticks.empty());
}

TEST(BaseBridge, WrongBaudRateIsNamed) {
  Base base("wrong_baud");
  EXPECT_TRUE(spinUntil([&] { return base.says("check the baud rate (500000 here)"); })) << base.status();
}

}  // namespace
}  // namespace stereo_nav::test
