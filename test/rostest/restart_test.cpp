// Processes of the graph are killed in turn while the recording loops; the rest recovers without help.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <signal.h>
#include <topic_tools/shape_shifter.h>

#include <map>

#include "ros/slave_api.h"
#include "rostest/graph_probe.h"

namespace stereo_nav::test {
namespace {

constexpr double kRecovery_s = 60.0;

/// 0 while the node does not answer.
pid_t processOf(const std::string& node) {
  XmlRpc::XmlRpcValue pid;
  return ros_io::askNode(node, "getPid", pid) ? static_cast<int>(pid) : 0;
}

/// The loader of a nodelet sends a heartbeat each second once the nodelet is loaded. bond 1.8 does not notice
/// the end of a manager of which it has seen no more than one: the next process is not killed before the
/// third.
constexpr int kBonded = 3;

class Restart : public testing::TestWithParam<const char*> {};

TEST_P(Restart, TheRestRecovers) {
  GraphProbe probe;
  std::map<std::string, int> heartbeats;  // by the node that sends them
  using Heartbeat = ros::MessageEvent<const topic_tools::ShapeShifter>;
  const boost::function<void(const Heartbeat&)> count = [&heartbeats](const Heartbeat& heartbeat) {
    ++heartbeats[heartbeat.getPublisherName()];
  };
  ros::NodeHandle handle;
  const ros::Subscriber bonds =
      handle.subscribe<topic_tools::ShapeShifter>("/stereo_manager/bond", 100, count);
  const auto tracking = [&probe] {
    return !probe.status.empty() && probe.status.back().state == VoStatus::TRACKING;
  };
  ASSERT_TRUE(spinUntil(tracking, kRecovery_s));
  const pid_t before = processOf(GetParam());
  ASSERT_GT(before, 0) << GetParam();
  ASSERT_EQ(kill(before, SIGKILL), 0);

  pid_t after = before;
  ASSERT_TRUE(spinUntil(
      [&] {
        after = processOf(GetParam());
        return after > 0 && after != before;
      },
      kRecovery_s))
      << GetParam() << " was not started again";
  probe.forget();
  heartbeats.clear();
  // What was on its way before may still come; twenty frames are new ones.
  EXPECT_TRUE(spinUntil([&] { return probe.odometry.size() >= 20 && tracking(); }, kRecovery_s));
  const std::string killed = GetParam();
  const bool is_loader = killed == "/left_rectify" || killed == "/stereo_disparity";
  EXPECT_TRUE(!is_loader || spinUntil([&] { return heartbeats[killed] >= kBonded; }, kRecovery_s))
      << killed << " has not loaded its nodelet again";
}

INSTANTIATE_TEST_SUITE_P(EachProcess, Restart,
                         testing::Values("/visual_odometry", "/left_rectify", "/stereo_disparity",
                                         "/stereo_manager"));

}  // namespace
}  // namespace stereo_nav::test
