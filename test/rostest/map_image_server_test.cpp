// The map_image_server node with the map hall.yaml, started by map_image_server.test.
#include <gtest/gtest.h>
#include <nav_msgs/GetMap.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>

#include <optional>

#include "support/command.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

void expectHall(const nav_msgs::OccupancyGrid& map) {
  EXPECT_EQ(map.header.frame_id, "map");
  ASSERT_EQ(map.info.width, 160u);
  ASSERT_EQ(map.info.height, 100u);
  EXPECT_NEAR(map.info.resolution, 0.05, 1e-6);
  EXPECT_NEAR(map.info.origin.position.x, -0.1, 1e-9);
  EXPECT_NEAR(map.info.origin.orientation.w, 1.0, 1e-9);
  const auto at = [&map](std::size_t x, std::size_t y) { return map.data[y * 160 + x]; };
  EXPECT_EQ(at(1, 50), 100);    // a wall
  EXPECT_EQ(at(50, 50), 0);     // the floor
  EXPECT_EQ(at(105, 65), 100);  // the pillar, above the middle
  EXPECT_EQ(at(105, 35), 0);
}

TEST(MapImageServer, LatchesTheMapAndAnswersTheService) {
  ros::NodeHandle handle;
  ASSERT_TRUE(ros::service::waitForService("static_map", ros::Duration(60.0)));
  // The subscription comes after the only message.
  std::optional<nav_msgs::OccupancyGrid> map;
  const ros::Subscriber subscriber = handle.subscribe<nav_msgs::OccupancyGrid>(
      "map", 1, [&map](const nav_msgs::OccupancyGrid::ConstPtr& message) { map = *message; });
  ASSERT_TRUE(spinUntil([&map] { return map.has_value(); }));
  expectHall(*map);
  nav_msgs::GetMap service;
  ASSERT_TRUE(ros::service::call("static_map", service));
  expectHall(service.response.map);
}

TEST(MapImageServer, RefusesWhatIsNoMap) {
  const auto refusal = [](const std::string& map) {
    return runCommand("timeout 60 " MAP_IMAGE_SERVER " __name:=refused _map:=" + map);
  };
  const auto missing = refusal("/nowhere/hall.yaml");
  EXPECT_EQ(missing.status, 2);
  EXPECT_NE(missing.output.find("/nowhere/hall.yaml"), std::string::npos) << missing.output;
  const auto image = refusal(STEREO_NAV_SOURCE_DIR "/test/rostest/hall.pgm");
  EXPECT_EQ(image.status, 2);
  EXPECT_NE(image.output.find("hall.pgm"), std::string::npos) << image.output;
  const auto none = refusal("''");
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.output.find("map is not set: which map?"), std::string::npos) << none.output;
}

}  // namespace
}  // namespace stereo_nav::test
