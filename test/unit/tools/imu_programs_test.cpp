// imu_emulator on recorded motions, imu_drift on a recording; the programs as a user calls them.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Imu.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>

#include "core/angles.h"
#include "sensors/imu/module_angles.h"
#include "stereo_nav/core/trajectory.h"
#include "support/command.h"

namespace stereo_nav::test {
namespace {

namespace fs = std::filesystem;

/// A robot that turns and sways, `time_s` after the start of its recording.
imu::ModuleAngles anglesAt(double time_s) {
  return {wrapDegrees(160.0 + 30.0 * time_s), 4.0 * std::sin(time_s), -3.0 * std::sin(2.0 * time_s)};
}

constexpr double kStart_s = 1000.0, kDuration_s = 1.5, kSamplePeriod_s = 0.01;

class ImuPrograms : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  void writeTum(const std::string& name) const {
    Trajectory trajectory;
    for (double t = 0.0; t < kDuration_s + 1.0; t += kSamplePeriod_s) {
      StampedPose pose;
      pose.time_s = kStart_s + t;
      pose.T_world_body.linear() = imu::orientationFromModule(anglesAt(t)).toRotationMatrix();
      trajectory.push_back(pose);
    }
    std::ofstream(file(name)) << toTum(trajectory);
  }

  /// Writes `duration_s` of imu/data; the yaw drifts by `drift_deg_s` when the robot does not move.
  void writeBag(const std::string& name, double duration_s, bool moving, double drift_deg_s) const {
    rosbag::Bag bag(file(name), rosbag::bagmode::Write);
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0.0, 0.001);
    for (double t = 0.0; t < duration_s; t += kSamplePeriod_s) {
      const auto angles = moving ? anglesAt(t) : imu::ModuleAngles{drift_deg_s * t, 1.0, 2.0};
      const auto q = imu::orientationFromModule(angles);
      sensor_msgs::Imu message;
      message.header.stamp = ros::Time(kStart_s + t);
      message.orientation.w = q.w();
      message.orientation.x = q.x();
      message.orientation.y = q.y();
      message.orientation.z = q.z();
      message.angular_velocity.z = noise(random);
      bag.write("imu/data", message.header.stamp, message);
    }
  }

  /// The log of what the emulator sent is the motion that it was given.
  void expectMotionIn(const std::string& log) const {
    std::ifstream lines(file(log));
    std::size_t count = 0;
    double first_s = 0.0;
    for (std::string line; std::getline(lines, line);) {
      double time_s = 0.0, yaw_deg = 0.0, pitch_deg = 0.0, roll_deg = 0.0;
      if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &time_s, &yaw_deg, &pitch_deg, &roll_deg) != 4)
        continue;
      if (count++ == 0) first_s = time_s;
      const imu::ModuleAngles expected = anglesAt(time_s - first_s);
      EXPECT_NEAR(wrapDegrees(yaw_deg - expected.yaw_deg), 0.0, 0.01);
      EXPECT_NEAR(pitch_deg, expected.pitch_deg, 0.01);
      EXPECT_NEAR(roll_deg, expected.roll_deg, 0.01);
    }
    EXPECT_EQ(count, 150u);
  }

  CommandResult emulate(const std::string& motion, const std::string& log) const {
    return runCommand(IMU_EMULATOR " --duration 1.5 --rate 100 --log " + file(log) + " " + motion);
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("imu_programs_test_" + std::to_string(getpid()));
};

TEST_F(ImuPrograms, TheEmulatorFollowsATrajectory) {
  writeTum("drive.tum");
  const auto result = emulate("--trajectory " + file("drive.tum"), "sent.csv");
  EXPECT_EQ(result.status, 0) << result.output;
  expectMotionIn("sent.csv");
}

TEST_F(ImuPrograms, TheEmulatorFollowsARecording) {
  writeBag("drive.bag", kDuration_s + 1.0, true, 0.0);
  const auto result = emulate("--bag " + file("drive.bag"), "sent.csv");
  EXPECT_EQ(result.status, 0) << result.output;
  expectMotionIn("sent.csv");
}

TEST_F(ImuPrograms, TheEmulatorRefusesWhatItCannotFollow) {
  writeBag("drive.bag", 1.0, true, 0.0);
  const auto wrong_topic = emulate("--bag " + file("drive.bag") + " --bag-topic imu/other", "sent.csv");
  EXPECT_EQ(wrong_topic.status, 2);
  EXPECT_NE(wrong_topic.output.find("no sensor_msgs/Imu with orientation on imu/other"), std::string::npos)
      << wrong_topic.output;
  std::ofstream(file("one.tum")) << "1000 0 0 0 0 0 0 1\n";
  for (const std::string& motion :
       {"--trajectory " + file("one.tum"), "--trajectory " + file("none.tum"), "--bag " + file("none.bag"),
        std::string("--motion wild"), std::string("--rates 1 2"), std::string("--baud 0")}) {
    const auto result = emulate(motion, "sent.csv");
    EXPECT_EQ(result.status, 2) << motion;
    EXPECT_EQ(result.output.find("imu_emulator: "), 0u) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
  }
}

TEST_F(ImuPrograms, TheDriftOfARecordingIsPrintedAndPlotted) {
  writeBag("rest.bag", 120.0, false, 2.9 / 600.0);
  const auto result = runCommand(IMU_DRIFT " --bag " + file("rest.bag") + " --output " + file("drift"));
  ASSERT_EQ(result.status, 0) << result.output;
  const auto row = result.output.find("  yaw ");
  ASSERT_NE(row, std::string::npos) << result.output;
  double total_deg = 0.0, slope_deg_min = 0.0;
  ASSERT_EQ(std::sscanf(result.output.c_str() + row, " yaw %lf %lf", &total_deg, &slope_deg_min), 2);
  EXPECT_NEAR(total_deg, 0.58, 0.01);
  EXPECT_NEAR(slope_deg_min, 0.29, 0.001);
  for (const std::string name : {"samples.csv", "drift.svg", "allan.svg"}) {
    EXPECT_GT(fs::file_size(file("drift") + "/" + name), 1000u) << name;
  }
  const auto neither = runCommand(IMU_DRIFT);
  EXPECT_EQ(neither.status, 2);
  EXPECT_NE(neither.output.find("give either --port or --bag"), std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::test
