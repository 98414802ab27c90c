// A recording through the whole graph, started by replay.launch: image nodelets, odometry, rosbag.
#include <gtest/gtest.h>
#include <tf2_ros/transform_listener.h>

#include <cmath>

#include "rostest/graph_probe.h"

namespace stereo_nav::test {
namespace {

constexpr std::size_t kFrames = 40;        // of the recording
constexpr double kLongWait_s = 90.0;       // for a loaded machine; nothing waits this long otherwise
constexpr double kPoseTolerance_m = 0.06;  // on a drive of 1.6 m, with the thesis' method

/// Ground truth at the stamp of an estimate; the recording has it at every image's.
const nav_msgs::Odometry* truthOf(const nav_msgs::Odometry& estimate, const GraphProbe& probe) {
  for (const auto& truth : probe.ground_truth) {
    if (std::abs((truth.header.stamp - estimate.header.stamp).toSec()) < 0.001) return &truth;
  }
  return nullptr;
}

class Replay : public testing::Test {
 protected:
  GraphProbe probe_;
};

TEST_F(Replay, EveryFrameBecomesOdometryNearTheGroundTruth) {
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  ASSERT_TRUE(probe_.waitUntil([&] { return !probe_.odometry.empty(); }, kLongWait_s))
      << "no odometry at all";
  ASSERT_TRUE(probe_.waitUntil([&] { return probe_.odometry.size() >= kFrames; }, kLongWait_s))
      << probe_.odometry.size() << " frames";

  const nav_msgs::Odometry& last = probe_.odometry.back();
  EXPECT_EQ(last.header.frame_id, "odom");
  EXPECT_EQ(last.child_frame_id, "base_link");
  ASSERT_TRUE(probe_.waitUntil([&] { return truthOf(last, probe_) != nullptr; }, kLongWait_s));
  EXPECT_LT(distance(last, *truthOf(last, probe_)), kPoseTolerance_m);
  EXPECT_LT(distance(probe_.odometry.front(), nav_msgs::Odometry()), 1e-9) << "the start is the origin";
  EXPECT_GT(last.twist.covariance[0], 0.0);
  EXPECT_GT(last.pose.covariance[0], probe_.odometry.front().pose.covariance[0]) << "uncertainty grows";

  ASSERT_TRUE(probe_.waitUntil([&] { return probe_.status.size() >= kFrames; }, kLongWait_s));
  EXPECT_EQ(probe_.status.back().frames, kFrames);
  EXPECT_EQ(probe_.status.back().frames_dropped, 0u);
  EXPECT_EQ(probe_.status.back().frames_lost, 0u);
  for (std::size_t i = 1; i < kFrames; ++i) {
    EXPECT_EQ(probe_.status[i].state, VoStatus::TRACKING) << probe_.status[i].reason;
    EXPECT_NEAR((probe_.odometry[i].header.stamp - probe_.odometry[i - 1].header.stamp).toSec(), 0.1, 1e-3);
  }

  std::string error;
  for (const char* sensor : {"camera_left_optical", "imu_link"}) {
    EXPECT_TRUE(probe_.waitUntil(
        [&] { return buffer.canTransform("odom", sensor, last.header.stamp, &error); }, kLongWait_s))
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
  ASSERT_TRUE(probe_.waitUntil([&] { return jump() > 0; }, kLongWait_s));
  ASSERT_TRUE(probe_.waitUntil([&] { return probe_.odometry.size() >= jump() + 10; }, kLongWait_s));
  EXPECT_TRUE(probe_.waitForLog("jumped back", kLongWait_s));

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
  EXPECT_LT(distance(tenth, *truthOf(tenth, probe_)), kPoseTolerance_m);
}

}  // namespace
}  // namespace stereo_nav::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "replay_test");
  ros::NodeHandle handle;  // keeps the node alive between tests
  return RUN_ALL_TESTS();
}
