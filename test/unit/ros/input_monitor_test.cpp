#include "ros/input_monitor.h"

#include <gtest/gtest.h>

#include "ros/latency_window.h"
#include "ros/problem_list.h"
#include "support/text.h"

namespace stereo_nav::ros_io {
namespace {

constexpr double kTimeout_s = 3.0;

struct Watched {
  InputMonitor monitor{kTimeout_s, 0.0};
  unsigned int publishers = 1;
  std::size_t left =
      monitor.add({"/camera/left/image_rect", "Rectify.", true, [this] { return publishers; }});
  std::size_t disparity =
      monitor.add({"/camera/disparity", "Disparity.", true, [this] { return publishers; }});
};

TEST(InputMonitor, SaysNothingBeforeTheTimeout) {
  Watched watched;
  for (const auto& text : watched.monitor.silentInputs(2.9)) EXPECT_EQ(text.second, "");
  EXPECT_EQ(watched.monitor.unsynchronised(2.9), "");
}

TEST(InputMonitor, NamesTheSilentTopicItsLastStampAndTheCause) {
  Watched watched;
  watched.monitor.received(watched.left, ros::Time(100.5), 1.0);
  watched.monitor.received(watched.disparity, ros::Time(105.0), 4.9);
  auto texts = watched.monitor.silentInputs(5.0);
  EXPECT_EQ(texts["/camera/disparity"], "");
  const std::string text = texts["/camera/left/image_rect"];
  EXPECT_TRUE(contains(text, "no message on /camera/left/image_rect for 4 s (1 before, last stamp 100.500)"))
      << text;
  EXPECT_TRUE(contains(text, "1 connected publisher(s) send nothing")) << text;
  EXPECT_TRUE(contains(text, "Rectify.")) << text;

  watched.publishers = 0;
  texts = watched.monitor.silentInputs(5.0);
  EXPECT_TRUE(contains(texts["/camera/left/image_rect"], "no node publishes it"));
}

TEST(InputMonitor, ExplainsStampsThatNeverMatch) {
  Watched watched;
  watched.monitor.received(watched.left, ros::Time(100.0), 4.0);
  watched.monitor.received(watched.disparity, ros::Time(100.02), 4.0);
  std::string text = watched.monitor.unsynchronised(4.5);
  EXPECT_TRUE(contains(text, "/camera/left/image_rect 100.000")) << text;
  EXPECT_TRUE(contains(text, "/camera/disparity 100.020 (+0.020 s)")) << text;
  EXPECT_TRUE(contains(text, "max_time_offset_s")) << text;

  watched.monitor.received(watched.disparity, ros::Time(7000.0), 4.0);
  text = watched.monitor.unsynchronised(4.5);
  EXPECT_TRUE(contains(text, "different clocks")) << text;

  watched.monitor.frameCompleted(4.4);
  EXPECT_EQ(watched.monitor.unsynchronised(4.5), "");
}

TEST(InputMonitor, ASilentTopicExplainsMissingFramesAlone) {
  Watched watched;
  watched.monitor.received(watched.left, ros::Time(100.0), 4.0);
  EXPECT_EQ(watched.monitor.unsynchronised(4.5), "");
}

TEST(ProblemList, IsSaidWhenNewAndAgainAfterAWhile) {
  ProblemList problems(10.0);
  EXPECT_TRUE(problems.raise("tf", true, "waiting for 3 s", 0.0));
  EXPECT_FALSE(problems.raise("tf", true, "waiting for 4 s", 1.0));
  EXPECT_EQ(problems.all().at("tf").text, "waiting for 4 s");
  EXPECT_TRUE(problems.raise("tf", true, "waiting for 13 s", 10.0));
  EXPECT_TRUE(problems.clear("tf"));
  EXPECT_FALSE(problems.clear("tf"));
  EXPECT_TRUE(problems.raise("tf", true, "again", 11.0));
}

TEST(LatencyWindow, Quantiles) {
  LatencyWindow window;
  EXPECT_EQ(window.quantile(0.5), 0.0);
  for (int i = 100; i >= 0; --i) window.add(i);
  EXPECT_EQ(window.quantile(0.5), 50.0);
  EXPECT_EQ(window.quantile(0.95), 95.0);
  for (int i = 0; i < 5000; ++i) window.add(7.0);
  EXPECT_EQ(window.size(), 2000u);
  EXPECT_EQ(window.quantile(0.95), 7.0);
}

}  // namespace
}  // namespace stereo_nav::ros_io
