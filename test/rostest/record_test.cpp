// record.launch with simulated devices: a closed bag holds everything that evaluate needs, and the disk is
// watched. Started by record.test with the folder of the recordings.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include <filesystem>
#include <set>

#include "rostest/diagnostics_probe.h"
#include "rostest/graph_probe.h"

namespace stereo_nav::test {
namespace {

namespace fs = std::filesystem;

constexpr double kRecording_s = 180.0;  // two bags; the rest is for a loaded machine

std::vector<fs::path> closedBags() {
  std::vector<fs::path> bags;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(ros::param::param<std::string>("~folder", ""), error)) {
    if (entry.path().extension() == ".bag") bags.push_back(entry.path());
  }
  std::sort(bags.begin(), bags.end());
  return bags;
}

TEST(Record, TheRateAndWhatIsLeftOfTheDiskAreTold) {
  const DiagnosticsProbe diagnostics;
  GraphProbe probe;
  EXPECT_TRUE(spinUntil([&] { return diagnostics.says("recorder: recording", " MB/s, "); }, kRecording_s))
      << diagnostics.textOf("recorder: recording");
  EXPECT_TRUE(diagnostics.says("recorder: recording", "the disk lasts "));
  EXPECT_TRUE(probe.waitForLog("recording ", kRecording_s));
}

TEST(Record, AClosedBagHoldsWhatTheOdometryNeeds) {
  GraphProbe probe;
  ASSERT_TRUE(spinUntil([] { return closedBags().size() >= 2; }, kRecording_s));
  // The second one shows that what was sent once, tf_static, is in each.
  const rosbag::Bag bag(closedBags()[1].string());
  std::map<std::string, int> counts;
  std::set<std::string> frames;
  for (const auto& message : rosbag::View(bag)) {
    ++counts[message.getTopic()];
    if (const auto transforms = message.instantiate<tf2_msgs::TFMessage>()) {
      for (const auto& transform : transforms->transforms) frames.insert(transform.child_frame_id);
    }
  }
  for (const std::string topic :
       {"/camera/left/image_raw", "/camera/right/image_raw", "/camera/left/camera_info",
        "/camera/right/camera_info", "/camera/sync", "/imu/data"}) {
    EXPECT_GT(counts[topic], 10) << topic;
  }
  EXPECT_EQ(frames, (std::set<std::string>{"camera_left_optical", "imu_link"}));
}

}  // namespace
}  // namespace stereo_nav::test
