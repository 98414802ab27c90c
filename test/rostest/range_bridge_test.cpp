// A range_bridge node on emulated range finders, started by range_bridge.test.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/Range.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "rostest/diagnostics_probe.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

TEST(RangeBridge, PublishesEachFinderByRep117AndResumes) {
  ros::NodeHandle handle;
  std::map<std::string, std::vector<sensor_msgs::Range>> ranges;
  std::vector<ros::Subscriber> subscribers;
  for (const std::string name : {"front", "left", "sky"}) {
    subscribers.push_back(handle.subscribe<sensor_msgs::Range>(
        "range/" + name, 1000,
        [&ranges, name](const sensor_msgs::Range::ConstPtr& range) { ranges[name].push_back(*range); }));
  }
  DiagnosticsProbe diagnostics;
  ASSERT_TRUE(spinUntil([&] {
    return ranges["front"].size() > 100 && ranges["left"].size() > 10 && ranges["sky"].size() > 10;
  }));

  const sensor_msgs::Range& front = ranges["front"].back();
  EXPECT_EQ(front.header.frame_id, "range_front");
  EXPECT_NEAR(front.field_of_view, 0.0628, 1e-4);
  EXPECT_EQ(front.min_range, 0.1F);
  EXPECT_EQ(front.max_range, 12.0F);
  for (const auto& range : ranges["front"]) EXPECT_NEAR(range.range, 1.21, 1e-6);
  EXPECT_EQ(ranges["sky"].back().range, INFINITY);
  EXPECT_EQ(ranges["sky"].back().header.frame_id, "mast");

  EXPECT_TRUE(spinUntil([&] { return diagnostics.says("range_bridge: range left", "connections: 2"); }))
      << diagnostics.textOf("range_bridge: range left");
  ranges["left"].clear();
  EXPECT_TRUE(spinUntil([&] { return !ranges["left"].empty(); }));
  EXPECT_TRUE(spinUntil([&] { return diagnostics.says("range_bridge: range sky", "strength: 20"); }));
}

}  // namespace
}  // namespace stereo_nav::test
