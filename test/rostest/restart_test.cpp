// Processes of the graph are killed in turn while the recording loops; the rest recovers without help.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <signal.h>

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

class Restart : public testing::TestWithParam<const char*> {};

TEST_P(Restart, TheRestRecovers) {
  GraphProbe probe;
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
  // What was on its way before may still come; twenty frames are new ones.
  EXPECT_TRUE(spinUntil([&] { return probe.odometry.size() >= 20 && tracking(); }, kRecovery_s));
}

INSTANTIATE_TEST_SUITE_P(EachProcess, Restart,
                         testing::Values("/visual_odometry", "/left_rectify", "/stereo_disparity",
                                         "/stereo_manager"));

}  // namespace
}  // namespace stereo_nav::test
