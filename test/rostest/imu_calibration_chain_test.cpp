// From a raw module with errors through calibrate_imu and its file to an imu_bridge that corrects them.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>

#include "stereo_nav/core/trajectory.h"
#include "stereo_nav/sensors/imu/calibration.h"
#include "support/command.h"
#include "support/node_process.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kRest_s = 4.0, kTurn_s = 5.5;  // a turn at 1.14 rad/s
constexpr double kTilt_rad = 0.2;
const std::string kErrors =
    "--gyro-bias 0.02 -0.01 0.03 --gyro-noise 0.001 --accelerometer-offset 0.3 -0.2 0.1 --accelerometer-gain "
    "1.03 0.98 1.02 --accelerometer-noise 0.02";
const Vector3d kBias(0.02, -0.01, 0.03), kOffset(0.3, -0.2, 0.1), kGain(1.03, 0.98, 1.02);

/// At rest, then once about each axis; the turn about z with x pointing up, so that every axis meets gravity.
Quaterniond handTurns(double time_s) {
  const double since_s = std::max(0.0, time_s - kRest_s);
  const int axis = std::min(2, static_cast<int>(since_s / kTurn_s));
  const double angle = 2.0 * M_PI * std::min(1.0, since_s / kTurn_s - axis);
  const Quaterniond start =
      axis == 2 ? Quaterniond(AngleAxisd(-M_PI / 2, Vector3d::UnitY())) : Quaterniond::Identity();
  return start * Quaterniond(AngleAxisd(angle, Vector3d::Unit(axis)));
}

Quaterniond tiltedAtRest(double /*time_s*/) {
  return Quaterniond(AngleAxisd(kTilt_rad, Vector3d::UnitY()));
}

/// The motion that imu_emulator follows.
void writeTrajectory(const std::string& path, Quaterniond (*attitude)(double), double duration_s) {
  Trajectory trajectory;
  for (double t = 0.0; t < duration_s; t += 0.02) {
    StampedPose pose;
    pose.time_s = 1000.0 + t;
    pose.T_world_body.linear() = attitude(t).toRotationMatrix();
    trajectory.push_back(pose);
  }
  std::ofstream(path) << toTum(trajectory);
}

std::unique_ptr<NodeProcess> startModule(const std::string& folder, const std::string& motion) {
  return std::make_unique<NodeProcess>(std::vector<std::string>{
      "/bin/sh", "-c",
      "exec " IMU_EMULATOR " --protocol raw --rate 200 --baud 1000000 --wait-for-reader --link " + folder +
          "/module --trajectory " + folder + "/" + motion + " " + kErrors});
}

void expectFound(const std::string& file) {
  const imu::ImuCalibration found = imu::loadCalibration(file);
  EXPECT_LT((found.gyroscope_bias.value - kBias).norm(), 5e-4) << found.gyroscope_bias.value.transpose();
  EXPECT_LT((found.accelerometer_offset.value - kOffset).norm(), 0.02)
      << found.accelerometer_offset.value.transpose();
  EXPECT_LT((found.accelerometer_scale.value.cwiseProduct(kGain) - Vector3d::Ones()).norm(), 2e-3)
      << found.accelerometer_scale.value.transpose();
}

TEST(ImuCalibration, WhatCalibrateImuFindsTheBridgeTakesOff) {
  const std::string folder = ros::param::param<std::string>("~folder", "");
  writeTrajectory(folder + "/turns.tum", handTurns, kRest_s + 3 * kTurn_s);
  writeTrajectory(folder + "/rest.tum", tiltedAtRest, 1.0);
  const std::string file = folder + "/calibration.yaml";
  std::filesystem::remove(file);

  auto module = startModule(folder, "turns.tum");
  // The module begins with its rest when the program opens the port.
  const auto result =
      runCommand(CALIBRATE_IMU " --port " + folder + "/module --rest 3 --turns 16.5 --output " + file);
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(module->stop(), 0);
  expectFound(file);

  module = startModule(folder, "rest.tum");
  std::vector<sensor_msgs::Imu> data;
  ros::NodeHandle handle;
  const ros::Subscriber subscriber = handle.subscribe<sensor_msgs::Imu>(
      "imu/data", 10000, [&](const sensor_msgs::Imu::ConstPtr& message) { data.push_back(*message); });
  const NodeProcess bridge({IMU_BRIDGE, "_port:=" + folder + "/module", "_protocol:=raw",
                            "_baud_rate:=1000000", "_calibration_file:=" + file});
  spinUntil([&data] { return data.size() >= 400; });
  ASSERT_GE(data.size(), 400u);
  Vector3d rate = Vector3d::Zero(), acceleration = Vector3d::Zero();
  for (const auto& message : data) {
    const auto& w = message.angular_velocity;
    const auto& a = message.linear_acceleration;
    rate += Vector3d(w.x, w.y, w.z) / static_cast<double>(data.size());
    acceleration += Vector3d(a.x, a.y, a.z) / static_cast<double>(data.size());
  }
  EXPECT_LT(rate.norm(), 1e-3) << rate.transpose();
  const Vector3d expected = tiltedAtRest(0.0).conjugate() * Vector3d(0.0, 0.0, 9.80665);
  EXPECT_LT((acceleration - expected).norm(), 0.03) << acceleration.transpose();
  const auto& q = data.back().orientation;
  EXPECT_LT(Quaterniond(q.w, q.x, q.y, q.z).angularDistance(tiltedAtRest(0.0)), 0.01)
      << "2 deg without the file";
}

TEST(ImuCalibration, APhoneIsCalibratedOverUdp) {
  const std::string folder = ros::param::param<std::string>("~folder", "");
  writeTrajectory(folder + "/turns.tum", handTurns, kRest_s + 3 * kTurn_s);
  const std::string file = folder + "/phone.yaml";
  std::filesystem::remove(file);
  // The program listens before the phone sends.
  const auto result = runCommand("(sleep 1; exec " IMU_EMULATOR
                                 " --udp udp:45685 --protocol phone --rate 200 --duration 25 "
                                 "--trajectory " +
                                 folder + "/turns.tum " + kErrors +
                                 ") > /dev/null 2>&1 & exec " CALIBRATE_IMU
                                 " --port udp:45685 --protocol phone --rest 3 --turns 16.5 --output " +
                                 file);
  ASSERT_EQ(result.status, 0) << result.output;
  expectFound(file);
}

}  // namespace
}  // namespace stereo_nav::test
