// The driven simulator, stepped, started by driven_simulator.test: the same commands give the same messages.
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "stereo_nav/WheelTicks.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

constexpr int kSteps = 60;
constexpr double kStep_s = 0.02;

/// All messages of a drive by topic, as bytes behind the header; stamps count from its start.
using Drive = std::map<std::string, std::vector<std::string>>;

class DrivenSimulator : public testing::Test {
 protected:
  DrivenSimulator() {
    velocity_ = handle_.advertise<geometry_msgs::Twist>("cmd_vel", 10);
    subscribers_.push_back(handle_.subscribe<rosgraph_msgs::Clock>(
        "/clock", 100, [this](const rosgraph_msgs::Clock::ConstPtr& clock) { answer(clock->clock); }));
    keep<WheelTicks>("wheel_ticks");
    keep<sensor_msgs::LaserScan>("scan");
    keep<sensor_msgs::Range>("range/front");
    keep<sensor_msgs::Imu>("imu/data");
    keep<sensor_msgs::Image>("camera/left/image_raw");
    keep<sensor_msgs::Image>("camera/right/image_raw");
    keep<nav_msgs::Odometry>("ground_truth/odom");
    subscribers_.push_back(handle_.subscribe<nav_msgs::Odometry>(
        "ground_truth/odom", 1000,
        [this](const nav_msgs::Odometry::ConstPtr& truth) { x_m_ = truth->pose.pose.position.x; }));
  }

  template <class Message>
  void keep(const std::string& topic) {
    subscribers_.push_back(
        handle_.subscribe<Message>(topic, 1000, [this, topic](const typename Message::ConstPtr& message) {
          Message relative = *message;
          relative.header.seq = 0;
          relative.header.stamp = ros::Time(1) + (message->header.stamp - start_);
          std::string bytes(ros::serialization::serializationLength(relative), '\0');
          ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                             static_cast<std::uint32_t>(bytes.size()));
          ros::serialization::serialize(stream, relative);
          drive_[topic].push_back(bytes);
        }));
  }

  /// One velocity for each step; the last one is answered when the simulation stands.
  void answer(const ros::Time& clock) {
    clock_ = clock;
    if (++steps_ >= kSteps) return;
    geometry_msgs::Twist twist;
    twist.linear.x = 0.3;
    twist.angular.z = steps_ < kSteps / 2 ? 0.4 : -0.4;
    velocity_.publish(twist);
  }

  /// Returns the simulation's time, which the response ends with.
  double pause(bool is_paused) {
    std_srvs::SetBool request;
    request.request.data = static_cast<unsigned char>(is_paused);
    EXPECT_TRUE(ros::service::call("simulator/pause", request));
    const std::size_t at = request.response.message.find(" at ");
    return at == std::string::npos ? -1.0 : std::stod(request.response.message.substr(at + 4));
  }

  Drive driveFromTheStart() {
    std_srvs::Trigger reset;
    EXPECT_TRUE(ros::service::call("simulator/reset", reset));
    start_ = clock_;
    drive_.clear();
    steps_ = 0;
    pause(false);
    EXPECT_TRUE(spinUntil([this] { return steps_ >= kSteps; }));
    pause(true);
    velocity_.publish(geometry_msgs::Twist());  // ends the last step
    EXPECT_TRUE(spinUntil([this] {
      for (const auto& [topic, count] : std::map<std::string, std::size_t>{{"wheel_ticks", 61},
                                                                           {"ground_truth/odom", 61},
                                                                           {"scan", 12},
                                                                           {"range/front", 25},
                                                                           {"imu/data", 120},
                                                                           {"camera/left/image_raw", 6},
                                                                           {"camera/right/image_raw", 6}}) {
        if (drive_[topic].size() < count) return false;
      }
      return true;
    }));
    EXPECT_NEAR((clock_ - start_).toSec(), kSteps * kStep_s, 1e-6);
    return drive_;
  }

  ros::NodeHandle handle_;
  ros::Publisher velocity_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Time clock_, start_;
  int steps_ = kSteps;
  double x_m_ = 0.0;
  Drive drive_;
};

TEST_F(DrivenSimulator, TheSameCommandsGiveTheSamePayloadsAndStamps) {
  ASSERT_TRUE(ros::service::waitForService("simulator/pause", 60000));
  ASSERT_TRUE(spinUntil([this] { return !clock_.is_zero() && velocity_.getNumSubscribers() > 0; }));
  const double paused_s = pause(true);
  if (paused_s > 0.0) velocity_.publish(geometry_msgs::Twist());  // ends the step that has begun
  ASSERT_TRUE(spinUntil([this, paused_s] {
    if (clock_.toSec() < 1000.0 + paused_s - 1e-6) return false;
    for (const auto& subscriber : subscribers_) {
      if (subscriber.getNumPublishers() == 0) return false;
    }
    return true;
  }));
  driveFromTheStart();  // in which messages from before may still arrive
  const Drive first = driveFromTheStart();
  EXPECT_GT(x_m_, 0.2);
  const Drive second = driveFromTheStart();
  for (const auto& [topic, messages] : first) {
    EXPECT_FALSE(messages.empty()) << topic;
    const auto& others = second.at(topic);
    ASSERT_EQ(messages.size(), others.size()) << topic;
    const auto differing = std::mismatch(messages.begin(), messages.end(), others.begin()).first;
    EXPECT_EQ(differing - messages.begin(), static_cast<std::ptrdiff_t>(messages.size()))
        << topic << ": the first message that differs";
  }
}

}  // namespace
}  // namespace stereo_nav::test
