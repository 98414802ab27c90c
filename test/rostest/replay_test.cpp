// A recording through the whole graph, started by replay.launch: image nodelets, odometry, rosbag.
#include <gtest/gtest.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_listener.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "rostest/graph_probe.h"
#include "stereo_nav/core/trajectory.h"

namespace stereo_nav::test {
namespace {

/// Ground truth at the stamp of an estimate; the recording has it at every image's.
const nav_msgs::Odometry* truthOf(const nav_msgs::Odometry& estimate, const GraphProbe& probe) {
  for (const auto& truth : probe.ground_truth) {
    if (std::abs((truth.header.stamp - estimate.header.stamp).toSec()) < 0.001) return &truth;
  }
  return nullptr;
}

/// The last pose that `evaluate` finds for the same recording, without a graph.
Eigen::Isometry3d evaluated(const std::string& bag, const std::string& config, const std::string& rig) {
  const std::string folder = testing::TempDir() + "replay_test_" + std::to_string(getpid());
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "evaluate";
  const std::string command = program.string() + " '" + bag + "'" +
                              (rig == "/" ? "" : " --namespace " + rig) + " --config " + config +
                              " --output " + folder + " > /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  const Trajectory trajectory = readTum(folder + "/trajectory.tum");
  std::filesystem::remove_all(folder);
  return trajectory.back().T_world_body;
}

std::string stampsOf(const std::vector<nav_msgs::Odometry>& messages) {
  std::ostringstream text;
  for (const auto& message : messages) text << message.header.stamp << " ";
  return text.str();
}

Eigen::Isometry3d poseOf(const nav_msgs::Odometry& odometry) {
  Eigen::Isometry3d pose;
  tf2::fromMsg(odometry.pose.pose, pose);
  return pose;
}

class Replay : public testing::Test {
 protected:
  const ros::NodeHandle parameters_{"~"};
  const double tolerance_m_ = parameters_.param("tolerance_m", 0.0);
  const std::size_t frames_ = static_cast<std::size_t>(parameters_.param("frames", 0));
  GraphProbe probe_;
};

TEST_F(Replay, EveryFrameBecomesOdometryNearTheGroundTruth) {
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  ASSERT_TRUE(spinUntil([&] { return !probe_.odometry.empty(); })) << "no odometry at all";
  ASSERT_TRUE(spinUntil([&] { return probe_.odometry.size() >= frames_; }))
      << "stamps of the frames: " << stampsOf(probe_.odometry);

  const nav_msgs::Odometry& last = probe_.odometry.back();
  EXPECT_EQ(last.header.frame_id, "odom");
  EXPECT_EQ(last.child_frame_id, "base_link");
  ASSERT_TRUE(spinUntil([&] { return truthOf(last, probe_) != nullptr; }));
  EXPECT_LT(distance(last, *truthOf(last, probe_)), tolerance_m_);
  EXPECT_LT(distance(probe_.odometry.front(), nav_msgs::Odometry()), 1e-9) << "the start is the origin";
  EXPECT_GT(last.twist.covariance[0], 0.0);
  EXPECT_GT(last.pose.covariance[0], probe_.odometry.front().pose.covariance[0]) << "uncertainty grows";

  ASSERT_TRUE(spinUntil([&] { return probe_.status.size() >= frames_; }));
  EXPECT_EQ(probe_.status.back().frames, frames_);
  EXPECT_EQ(probe_.status.back().frames_dropped, 0u);
  EXPECT_EQ(probe_.status.back().frames_lost, 0u);
  for (std::size_t i = 1; i < frames_; ++i) {
    const bool on_probation = i == 1 && probe_.status[i].state == VoStatus::INITIALISING;
    EXPECT_TRUE(on_probation || probe_.status[i].state == VoStatus::TRACKING) << probe_.status[i].reason;
    EXPECT_NEAR((probe_.odometry[i].header.stamp - probe_.odometry[i - 1].header.stamp).toSec(), 0.1, 1e-3);
  }

  const Eigen::Isometry3d difference =
      evaluated(parameters_.param<std::string>("bag", ""), parameters_.param<std::string>("config", ""),
                parameters_.param<std::string>("namespace", "/"))
          .inverse() *
      poseOf(last);
  constexpr double kHundredthDegree = 1.7e-4;
  EXPECT_LT(difference.translation().norm(), 0.001) << "graph and evaluate differ";
  EXPECT_LT(Eigen::AngleAxisd(difference.linear()).angle(), kHundredthDegree);

  std::string error;
  for (const char* sensor : {"camera_left_optical", "imu_link"}) {
    EXPECT_TRUE(spinUntil([&] { return buffer.canTransform("odom", sensor, last.header.stamp, &error); }))
        << error;
  }
}

TEST_F(Replay, ALoopOfTheBagStartsAnewAndIsSaid) {
  const auto jump = [this] {
    for (std::size_t i = 1; i < probe_.odometry.size(); ++i) {
      if (probe_.odometry[i].header.stamp < probe_.odometry[i - 1].header.stamp) return i;
    }
    return std::size_t{0};
  };
  ASSERT_TRUE(spinUntil([&] { return jump() > 0; }));
  ASSERT_TRUE(spinUntil([&] { return probe_.odometry.size() >= jump() + 10; }));
  EXPECT_TRUE(probe_.waitForLog("jumped back"));

  const std::size_t first = jump();
  const ros::Time stamp = probe_.odometry[first].header.stamp;
  EXPECT_LT(distance(probe_.odometry[first], nav_msgs::Odometry()), 1e-9) << "a replay starts at the origin";
  std::size_t until_tracking = 0;
  bool after_jump = false;
  for (const auto& status : probe_.status) {
    after_jump = after_jump || status.header.stamp == stamp;
    if (!after_jump) continue;
    if (status.state == VoStatus::TRACKING) break;
    ++until_tracking;
  }
  EXPECT_LE(until_tracking, 10u);
  const nav_msgs::Odometry& tenth = probe_.odometry[first + 9];
  ASSERT_NE(truthOf(tenth, probe_), nullptr);
  EXPECT_LT(distance(tenth, *truthOf(tenth, probe_)), tolerance_m_);
}

}  // namespace
}  // namespace stereo_nav::test
