#include "nodes/recorder/recorded_topics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::nodes {
namespace {

/// All that base_bridge, laser_bridge and range_bridge publish or obey for such a rig file.
TEST(RecordedTopics, HoldWhatTheRigFileNames) {
  ros_io::BaseBridgeParams base;
  readParameters(parseYaml("joints: 1\njoint_1: {name: tilt}\nranges: 1\nrange_1: {name: rear}\n"
                           "switches: 1\nswitch_1: {name: bumper}\nactuators: 1\nactuator_1: {name: intake}",
                           "base"),
                 "base", base);
  ros_io::RangeBridgeParams ranges;
  readParameters(parseYaml("finders: 2\nfinder_1: {name: front}\nfinder_2: {name: left}", "ranges"), "ranges",
                 ranges);
  const auto list = recordedTopics(base, ranges, "odom,tf");
  const std::set<std::string> names(list.begin(), list.end());
  EXPECT_EQ(names.size(), list.size()) << "each once";
  for (const std::string topic :
       {"scan", "wheel_ticks", "joint_states", "battery", "cmd_vel", "joints/tilt", "range/rear",
        "range/front", "range/left", "switch/bumper", "actuators/intake", "actuators/intake/state",
        "imu/data", "/tf_static", "/diagnostics", "odom", "tf"})
    EXPECT_EQ(names.count(topic), 1U) << topic;
}

TEST(RecordedTopics, HoldTheServoThatCarriesTheCamera) {
  ros_io::BaseBridgeParams base;
  readParameters(parseYaml("joints: 1\njoint_1: {name: tilt, carries_camera: true}", "base"), "base", base);
  const auto list = recordedTopics(base, ros_io::RangeBridgeParams(), "odom,tf");
  EXPECT_EQ(std::count(list.begin(), list.end(), "/tf"), 1) << "where the camera is";
  EXPECT_EQ(std::count(list.begin(), list.end(), "tf"), 0) << "once";
}

}  // namespace
}  // namespace stereo_nav::nodes
