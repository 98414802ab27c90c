// wheel_odometry nodes with wheels that the test turns, started by wheel_odometry.test.
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <tf2_ros/transform_listener.h>

#include "kinematics/drive_file.h"
#include "rostest/diagnostics_probe.h"
#include "stereo_nav/SetPose.h"
#include "stereo_nav/WheelTicks.h"
#include "support/ros_wait.h"
#include "unit/odometry/wheel/driven_wheels.h"

namespace stereo_nav::test {
namespace {

constexpr double kTickPeriod_s = 0.02;

kinematics::DriveParams driveOfTheTest() {
  return kinematics::readDrive(RigFile::load(ros::param::param<std::string>("~rig", "")));
}

/// A robot in a namespace, whose wheels turn as fast as the test goes.
class WheeledRobot {
 public:
  explicit WheeledRobot(const std::string& name)
      : handle_(name), drive_(driveOfTheTest()), base_(drive_), start_(ros::Time::now()) {
    ticks_ = handle_.advertise<WheelTicks>("wheel_ticks", 1000);
    imu_ = handle_.advertise<sensor_msgs::Imu>("imu/data", 1000);
    odometry_ = handle_.subscribe<nav_msgs::Odometry>(
        "wheel/odom", 1000,
        [this](const nav_msgs::Odometry::ConstPtr& message) { odometry.push_back(*message); });
  }

  bool connected() const {
    return ticks_.getNumSubscribers() > 0 && imu_.getNumSubscribers() > 0 && odometry_.getNumPublishers() > 0;
  }

  void drive(const kinematics::Twist& twist, double duration_s, int reversed = -1) {
    for (int i = 0; i < std::lround(duration_s / kTickPeriod_s); ++i) {
      const auto before = base_.sample(false).pulses;
      base_.move(twist, kTickPeriod_s);
      const auto sample = base_.sample(false);
      WheelTicks message;
      message.header.stamp = start_ + ros::Duration(sample.time_s);
      message.header.frame_id = "base_link";
      if (counted_.empty()) counted_.assign(sample.pulses.size(), 0);
      for (std::size_t w = 0; w < counted_.size(); ++w) {
        const auto turned = sample.pulses[w] - before[w];
        counted_[w] += static_cast<int>(w) == reversed ? -turned : turned;
      }
      // In another order than in the rig file: names tell.
      for (std::size_t w = drive_.wheels.size(); w-- > 0;) {
        message.names.push_back(drive_.wheels[w].name);
        message.pulses.push_back(counted_[w]);
      }
      sensor_msgs::Imu imu;
      imu.header = message.header;
      imu.orientation_covariance[0] = -1.0;
      imu.angular_velocity.z = twist.z();
      imu_.publish(imu);
      ticks_.publish(message);
      ros::spinOnce();
      ros::WallDuration(0.001).sleep();
    }
  }

  const Eigen::Isometry2d& pose() const { return base_.pose(); }
  ros::NodeHandle& handle() { return handle_; }

  std::vector<nav_msgs::Odometry> odometry;

 private:
  ros::NodeHandle handle_;
  kinematics::DriveParams drive_;
  odometry::DrivenWheels base_;
  ros::Time start_;
  std::vector<std::int64_t> counted_;
  ros::Publisher ticks_, imu_;
  ros::Subscriber odometry_;
};

TEST(WheelOdometryNode, FollowsTheRobotAndTakesThePoseThatIsSet) {
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  WheeledRobot robot("/");
  ASSERT_TRUE(spinUntil([&] { return robot.connected(); }));
  robot.drive({0.0, 0.0, 0.0}, 0.1);
  ASSERT_TRUE(spinUntil([&] { return !robot.odometry.empty(); }));
  robot.drive({0.5, 0.2, 0.6}, 4.0);
  robot.drive({-0.3, 0.0, -0.2}, 2.0);
  const auto last = robot.pose().translation();
  ASSERT_TRUE(spinUntil([&] { return robot.odometry.size() > 300; })) << robot.odometry.size();
  const nav_msgs::Odometry& message = robot.odometry.back();
  EXPECT_NEAR(message.pose.pose.position.x, last.x(), 0.02);
  EXPECT_NEAR(message.pose.pose.position.y, last.y(), 0.02);
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.child_frame_id, "base_link");
  EXPECT_NEAR(message.twist.twist.linear.x, -0.3, 0.02);
  EXPECT_NEAR(message.twist.twist.angular.z, -0.2, 0.02);
  EXPECT_GT(message.pose.covariance[0], 0.0);
  EXPECT_GT(message.twist.covariance[35], 0.0);
  EXPECT_GT(message.pose.covariance[14], 1e5) << "wheels know nothing of z";
  EXPECT_TRUE(spinUntil([&] { return buffer.canTransform("odom", "base_link", ros::Time(0)); }));

  SetPose set;
  set.request.pose.header.frame_id = "map";
  set.request.pose.pose.pose.orientation.w = 1.0;
  auto client = robot.handle().serviceClient<SetPose>("wheel/set_pose");
  ASSERT_TRUE(client.call(set));
  EXPECT_FALSE(set.response.success);
  EXPECT_NE(set.response.message.find("must be in 'odom'"), std::string::npos);
  set.request.pose.header.frame_id = "odom";
  set.request.pose.pose.pose.position.x = 5.0;
  ASSERT_TRUE(client.call(set));
  EXPECT_TRUE(set.response.success) << set.response.message;
  robot.drive({0.0, 0.0, 0.0}, 0.2);
  EXPECT_TRUE(spinUntil([&] { return std::abs(robot.odometry.back().pose.pose.position.x - 5.0) < 0.01; }));
}

TEST(WheelOdometryNode, AReversedEncoderIsNamedInTheDiagnostics) {
  DiagnosticsProbe probe;
  WheeledRobot robot("/other");
  ASSERT_TRUE(spinUntil([&] { return robot.connected(); }));
  const std::string status = "other/wheel_odometry: wheel odometry";
  for (int i = 0; i < 10; ++i) {
    robot.drive({0.4, 0.1, 0.5}, 1.0, 2);
    robot.drive({-0.2, 0.3, -0.4}, 1.0, 2);
  }
  EXPECT_TRUE(spinUntil([&] { return probe.says(status, "wheel_3 (rear_left) counts backwards"); }))
      << probe.names() << probe.textOf(status);
  EXPECT_EQ(probe.levelOf(status), 2);
  EXPECT_TRUE(spinUntil([&] { return probe.says(status, "no message on /other/wheel_ticks"); }))
      << probe.textOf(status);
}

}  // namespace
}  // namespace stereo_nav::test
