#include "ros/grid_messages.h"

#include <gtest/gtest.h>

#include <limits>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::ros_io {
namespace {

nav_msgs::OccupancyGrid turnedMap() {
  grid::GridGeometry geometry;
  geometry.width = 3;
  geometry.height = 2;
  geometry.resolution_m = 0.25;
  geometry.origin_x_m = -1.5;
  geometry.origin_y_m = 2.0;
  geometry.origin_yaw_rad = 0.3;
  grid::OccupancyGrid grid(geometry, grid::kFree);
  grid.at({2, 1}) = grid::kOccupied;
  grid.at({0, 1}) = grid::kUnknown;
  nav_msgs::OccupancyGrid message;
  fillMessage(grid, "map", ros::Time(7.0), message);
  return message;
}

TEST(GridMessages, ComeBackAsTheyWent) {
  const grid::OccupancyGrid grid = toGrid(turnedMap());
  EXPECT_EQ(grid.geometry.width, 3);
  EXPECT_EQ(grid.geometry.height, 2);
  EXPECT_EQ(grid.geometry.resolution_m, 0.25);
  EXPECT_NEAR(grid.geometry.origin_x_m, -1.5, 1e-12);
  EXPECT_NEAR(grid.geometry.origin_y_m, 2.0, 1e-12);
  EXPECT_NEAR(grid.geometry.origin_yaw_rad, 0.3, 1e-12);
  EXPECT_EQ(grid.at({2, 1}), grid::kOccupied);
  EXPECT_EQ(grid.at({0, 1}), grid::kUnknown);
}

TEST(GridMessages, ThatAreNoMapAreRefused) {
  nav_msgs::OccupancyGrid message = turnedMap();
  message.data.pop_back();
  EXPECT_THROW(toGrid(message), InputError);
  message = turnedMap();
  message.info.resolution = 0.0F;
  EXPECT_THROW(toGrid(message), InputError);
  message = turnedMap();
  message.info.origin.orientation.w = 0.0;
  message.info.origin.orientation.z = 0.0;
  EXPECT_THROW(toGrid(message), InputError);
  message = turnedMap();
  message.info.origin.position.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(toGrid(message), InputError);
  EXPECT_THROW(toGrid(nav_msgs::OccupancyGrid()), InputError);
}

}  // namespace
}  // namespace stereo_nav::ros_io
