// laser_odometry nodes with scans that the test makes, started by laser_odometry.test.
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>
#include <std_srvs/Empty.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_listener.h>

#include "core/planar_motion.h"
#include "rostest/diagnostics_probe.h"
#include "stereo_nav/LaserStatus.h"
#include "stereo_nav/SetPose.h"
#include "support/ros_wait.h"
#include "unit/odometry/laser/walled_world.h"

namespace stereo_nav::test {
namespace {

using odometry::PlanarPath;
using odometry::planarPose;
using odometry::TurningLaser;
using odometry::WalledWorld;

constexpr double kScanPeriod_s = 0.1;

/// Turns and drives, from rest.
Eigen::Vector3d wave(double time_s) {
  const double t = std::max(0.0, time_s - 0.5);
  return {0.8 * (1.0 - std::cos(0.5 * t)), 0.4 * std::sin(0.5 * t) * std::sin(0.25 * t),
          0.5 * (1.0 - std::cos(0.7 * t))};
}

/// A robot in a namespace, with a laser that is mounted as `T_base_laser` says.
class ScanningRobot {
 public:
  ScanningRobot(const std::string& name, const WalledWorld& world, PlanarPath path, std::string laser_frame,
                const Eigen::Isometry3d& T_base_laser)
      : handle_(name),
        path_(std::move(path)),
        T_base_laser_(T_base_laser),
        laser_{world, [this](double t) { return laserPose(t); }},
        laser_frame_(std::move(laser_frame)),
        start_(ros::Time::now()) {
    scan_ = handle_.advertise<sensor_msgs::LaserScan>("scan", 100);
    wheels_ = handle_.advertise<nav_msgs::Odometry>("wheel/odom", 1000);
    imu_ = handle_.advertise<sensor_msgs::Imu>("imu/data", 1000);
    odometry_ = handle_.subscribe<nav_msgs::Odometry>(
        "laser/odom", 1000,
        [this](const nav_msgs::Odometry::ConstPtr& message) { odometry.push_back(*message); });
    status_ = handle_.subscribe<LaserStatus>(
        "laser/status", 1000, [this](const LaserStatus::ConstPtr& message) { status.push_back(*message); });
  }

  bool connected() const {
    return scan_.getNumSubscribers() > 0 && wheels_.getNumSubscribers() > 0 && imu_.getNumSubscribers() > 0 &&
           odometry_.getNumPublishers() > 0 && status_.getNumPublishers() > 0;
  }

  /// Publishes `count` scans, with wheels and IMU to their ends where `prior` says so, and waits for what
  /// comes back.
  void drive(int count, bool prior, const std::function<void(sensor_msgs::LaserScan&)>& change = {}) {
    for (int i = 0; i < count; ++i) {
      const std::size_t known = odometry.size();
      if (prior) feed(kScanPeriod_s * (scans_ + 1) + 0.03);
      send(change);
      spinUntil([&] { return odometry.size() > known && status.size() > known; }, 5.0, 0.001);
    }
  }

  /// Publishes the next scan.
  void send(const std::function<void(sensor_msgs::LaserScan&)>& change) {
    sensor_msgs::LaserScan message = scanAt(kScanPeriod_s * scans_++);
    if (change) change(message);
    scan_.publish(message);
  }

  /// Of the last message.
  Eigen::Vector3d error() const {
    const nav_msgs::Odometry& last = odometry.back();
    const double time_s = (last.header.stamp - start_).toSec();
    Eigen::Isometry3d T;
    tf2::fromMsg(last.pose.pose, T);
    const Eigen::Isometry2d truth = planarPose(path_(0.0)).inverse() * planarPose(path_(time_s));
    return logPlanar(truth.inverse() * planarPart(T));
  }

  ros::NodeHandle& handle() { return handle_; }
  ros::Time stampOf(int scan) const { return start_ + ros::Duration(kScanPeriod_s * scan); }

  std::vector<nav_msgs::Odometry> odometry;
  std::vector<LaserStatus> status;

 private:
  /// Of the laser as seen from above: one that hangs turns the other way.
  Eigen::Vector3d laserPose(double time_s) const {
    const Eigen::Isometry2d T = planarPose(path_(time_s)) * planarPart(T_base_laser_);
    return {T.translation().x(), T.translation().y(), std::atan2(T(1, 0), T(0, 0))};
  }

  sensor_msgs::LaserScan scanAt(double time_s) {
    odometry::LaserScan scan = laser_.scan(time_s);
    sensor_msgs::LaserScan message;
    message.header.stamp = start_ + ros::Duration(time_s);
    message.header.frame_id = laser_frame_;
    // The beams of the world turn counterclockwise, which one that hangs sees as clockwise.
    const float sign = T_base_laser_(2, 2) > 0.0 ? 1.0F : -1.0F;
    message.angle_min = sign * static_cast<float>(scan.angle_min_rad);
    message.angle_increment = sign * static_cast<float>(scan.angle_increment_rad);
    message.time_increment = static_cast<float>(scan.time_increment_s);
    message.range_min = static_cast<float>(scan.range_min_m);
    message.range_max = static_cast<float>(scan.range_max_m);
    message.ranges = scan.ranges_m;
    return message;
  }

  void feed(double to_s) {
    for (; fed_s_ < to_s; fed_s_ += 0.01) {
      const Eigen::Vector3d pose = path_(fed_s_);
      nav_msgs::Odometry wheels;
      wheels.header.stamp = start_ + ros::Duration(fed_s_);
      wheels.child_frame_id = "base_footprint";  // tf does not know it
      wheels.pose.pose = tf2::toMsg(inSpace(planarPose({1.05 * pose.x(), 1.05 * pose.y(), pose.z()})));
      wheels_.publish(wheels);
      sensor_msgs::Imu imu;
      imu.header.stamp = wheels.header.stamp;
      imu.header.frame_id = "base_footprint";
      imu.orientation_covariance[0] = -1.0;
      imu.angular_velocity.z = (path_(fed_s_ + 0.005).z() - path_(fed_s_ - 0.005).z()) / 0.01;
      imu_.publish(imu);
    }
  }

  ros::NodeHandle handle_;
  PlanarPath path_;
  Eigen::Isometry3d T_base_laser_;
  TurningLaser laser_;
  std::string laser_frame_;
  ros::Time start_;
  double fed_s_ = -0.05;
  int scans_ = 0;
  ros::Publisher scan_, wheels_, imu_;
  ros::Subscriber odometry_, status_;
};

Eigen::Isometry3d uprightLaser() {
  return Eigen::Isometry3d(Eigen::Translation3d(0.1, 0.0, 0.2));
}

TEST(LaserOdometryNode, FollowsTheRobotAndTakesThePoseThatIsSet) {
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  ScanningRobot robot("/", WalledWorld::room(7.0, 5.0), wave, "laser_link", uprightLaser());
  ASSERT_TRUE(spinUntil([&] { return robot.connected(); }));
  robot.drive(120, true);
  ASSERT_TRUE(spinUntil([&] { return robot.odometry.size() == 120 && robot.status.size() == 120; }))
      << robot.odometry.size();
  EXPECT_LT(robot.error().head<2>().norm(), 0.03) << robot.error().transpose();
  EXPECT_LT(std::abs(robot.error().z()), 0.01);
  const nav_msgs::Odometry& message = robot.odometry.back();
  EXPECT_EQ(message.header.stamp, robot.stampOf(119)) << "that of the scan";
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.child_frame_id, "base_link");
  EXPECT_GT(message.pose.covariance[0], 0.0);
  EXPECT_LT(message.pose.covariance[0], 0.01);
  EXPECT_GT(message.pose.covariance[14], 1e5) << "a planar laser knows nothing of z";
  const Eigen::Vector3d moved =
      logPlanar(planarPose(wave(11.8)).inverse() * planarPose(wave(11.9))) / kScanPeriod_s;
  EXPECT_NEAR(message.twist.twist.linear.x, moved.x(), 0.06);
  EXPECT_NEAR(message.twist.twist.angular.z, moved.z(), 0.03);
  EXPECT_LT(message.twist.covariance[0], 0.01);
  const LaserStatus& status = robot.status.back();
  EXPECT_EQ(status.state, LaserStatus::TRACKING) << status.reason;
  EXPECT_TRUE(status.wheels && status.gyroscope) << "in base_footprint, which needs no tf";
  EXPECT_GT(status.matched_share, 0.7);
  EXPECT_EQ(status.beams, 360u);
  EXPECT_EQ(status.scans, 120u);
  EXPECT_TRUE(robot.status.at(2).untold.empty());
  EXPECT_TRUE(spinUntil([&] { return buffer.canTransform("odom", "base_link", ros::Time(0)); }));

  SetPose set;
  set.request.pose.header.frame_id = "map";
  set.request.pose.pose.pose.orientation.w = 1.0;
  auto client = robot.handle().serviceClient<SetPose>("laser/set_pose");
  ASSERT_TRUE(client.call(set));
  EXPECT_FALSE(set.response.success);
  EXPECT_NE(set.response.message.find("must be in 'odom'"), std::string::npos);
  set.request.pose.header.frame_id = "odom";
  set.request.pose.pose.pose.position.x = 5.0;
  ASSERT_TRUE(client.call(set));
  EXPECT_TRUE(set.response.success) << set.response.message;
  robot.drive(1, true);
  EXPECT_NEAR(robot.odometry.back().pose.pose.position.x, 5.0, 0.1);
  std_srvs::Empty reset;
  ASSERT_TRUE(robot.handle().serviceClient<std_srvs::Empty>("laser/reset").call(reset));
  robot.drive(1, true);
  EXPECT_NEAR(robot.odometry.back().pose.pose.position.x, 0.0, 0.1);
}

TEST(LaserOdometryNode, ALaserThatHangsUpsideDownInTheNodeletByItself) {
  Eigen::Isometry3d T_base_laser(Eigen::Translation3d(-0.1, 0.05, 0.3));
  T_base_laser.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()));
  T_base_laser.rotate(Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX()));
  ScanningRobot robot("/nodelet", WalledWorld::room(7.0, 5.0), wave, "hanging_laser", T_base_laser);
  ASSERT_TRUE(spinUntil([&] { return robot.connected(); }));
  robot.drive(100, false);
  ASSERT_FALSE(robot.odometry.empty());
  EXPECT_LT(robot.error().head<2>().norm(), 0.04) << robot.error().transpose();
  EXPECT_LT(std::abs(robot.error().z()), 0.02);
  EXPECT_FALSE(robot.status.back().wheels || robot.status.back().gyroscope);
}

TEST(LaserOdometryNode, WhatTheScanDoesNotTellIsSaid) {
  DiagnosticsProbe probe;
  const PlanarPath straight = [](double t) { return Eigen::Vector3d(0.4 * t, 0.0, 0.0); };
  ScanningRobot robot("/corridor", WalledWorld::corridor(2.0), straight, "laser_link", uprightLaser());
  ASSERT_TRUE(spinUntil([&] { return robot.connected(); }));
  const std::string health = "corridor/laser_odometry: laser odometry";
  robot.drive(30, true);
  ASSERT_EQ(robot.status.size(), 30u);
  const LaserStatus& status = robot.status.back();
  EXPECT_EQ(status.state, LaserStatus::PARTLY);
  ASSERT_EQ(status.untold.size(), 1u);
  EXPECT_GT(std::abs(status.untold[0].x), 0.99);
  EXPECT_NE(status.reason.find("no wall in reach tells the motion along"), std::string::npos)
      << status.reason;
  EXPECT_EQ(status.scans_partly, 29u) << "all but the first";
  EXPECT_TRUE(spinUntil([&] { return probe.says(health, "no wall in reach"); })) << probe.textOf(health);
  EXPECT_EQ(probe.levelOf(health), 0) << "wheels tell the way";

  // Covered: nothing comes back, by REP-117.
  robot.drive(5, true, [](sensor_msgs::LaserScan& scan) {
    std::fill(scan.ranges.begin(), scan.ranges.end(), -std::numeric_limits<float>::infinity());
  });
  EXPECT_EQ(robot.status.back().state, LaserStatus::COASTING);
  EXPECT_EQ(robot.status.back().scans_coasting, 5u);
  EXPECT_TRUE(spinUntil([&] { return probe.says(health, "is the laser covered"); })) << probe.textOf(health);
  EXPECT_EQ(probe.levelOf(health), 1);
  EXPECT_LT(robot.error().head<2>().norm(), 0.15) << "5 % of the wheels' way";
  EXPECT_TRUE(spinUntil([&] { return probe.says(health, "no message on /corridor/scan"); }))
      << probe.textOf(health);
}

TEST(LaserOdometryNode, InputsThatCannotBeUsedAreNamed) {
  DiagnosticsProbe probe;
  ScanningRobot robot("/faulty", WalledWorld::room(7.0, 5.0), wave, "laser_link", uprightLaser());
  ASSERT_TRUE(spinUntil([&] { return robot.connected(); }));
  const std::string health = "faulty/laser_odometry: laser odometry";
  const auto becomes = [&](const std::string& frame, const std::string& text) {
    const auto says = [&] {
      robot.send([&](sensor_msgs::LaserScan& scan) { scan.header.frame_id = frame; });
      return probe.says(health, text);
    };
    return spinUntil(says, kLongWait_s, 0.1);
  };
  EXPECT_TRUE(becomes("unknown_laser", "waiting for the transform base_link -> unknown_laser"))
      << probe.textOf(health);
  EXPECT_TRUE(becomes("tilted_laser", "mounted with a tilt of 57 deg")) << probe.textOf(health);
  EXPECT_TRUE(becomes("laser_link", "tracking")) << probe.textOf(health);

  ros::NodeHandle other("/echoes");
  const ros::Publisher echoes = other.advertise<sensor_msgs::MultiEchoLaserScan>("scan", 1);
  const auto refused = [&] {
    echoes.publish(sensor_msgs::MultiEchoLaserScan());
    return probe.says("echoes/laser_odometry: laser odometry",
                      "/echoes/scan is sensor_msgs/MultiEchoLaserScan, expected is sensor_msgs/LaserScan");
  };
  EXPECT_TRUE(spinUntil(refused, kLongWait_s, 0.1)) << probe.names();
}

}  // namespace
}  // namespace stereo_nav::test
