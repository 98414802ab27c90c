// What the navigator makes of messages, good and bad ones.
#include "nodes/navigator/navigator_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/angles.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::nodes {
namespace {

TEST(NavigatorMessages, AGridKeepsItsPlaceAndItsCells) {
  nav_msgs::OccupancyGrid message;
  message.info.resolution = 0.5F;
  message.info.width = 3;
  message.info.height = 2;
  message.info.origin = toMessage({{1.0, -2.0}, 0.5 * kPi});
  message.data = {0, 100, -1, 50, 65, 0};
  const grid::OccupancyGrid grid = toGrid(message);
  EXPECT_EQ(grid.at({1, 0}), 100);
  EXPECT_EQ(grid.at({0, 1}), 50);
  EXPECT_LT((grid.geometry.centreOf({1, 0}) - Eigen::Vector2d(0.75, -1.25)).norm(), 1e-6);
  message.data.pop_back();
  EXPECT_THROW(toGrid(message), InputError);
  EXPECT_THROW(toGrid(nav_msgs::OccupancyGrid()), InputError);
}

TEST(NavigatorMessages, APoseHasAHeadingUnlessItsOrientationIsZero) {
  const auto turned = toFloorPose(toMessage({{1.0, 2.0}, -2.0}));
  ASSERT_TRUE(turned && turned->heading_rad);
  EXPECT_NEAR(*turned->heading_rad, -2.0, 1e-12);
  const auto free = toFloorPose(geometry_msgs::Pose());
  ASSERT_TRUE(free);
  EXPECT_FALSE(free->heading_rad);
}

TEST(NavigatorMessages, APoseThatIsNoneIsRefused) {
  geometry_msgs::Pose pose = toMessage({{1.0, 2.0}, 0.3});
  pose.orientation.w = 2.0;
  EXPECT_FALSE(toFloorPose(pose));
  pose = toMessage({{1.0, std::nan("")}, 0.3});
  EXPECT_FALSE(toFloorPose(pose));
}

TEST(NavigatorMessages, ThePointsOfAWayLookAlongIt) {
  const nav_msgs::Path path = toPath({{0.0, 0.0}, {0.0, 1.0}, {-1.0, 1.0}}, "map", ros::Time(5.0));
  ASSERT_EQ(path.poses.size(), 3U);
  EXPECT_NEAR(*toFloorPose(path.poses[0].pose)->heading_rad, 0.5 * kPi, 1e-12);
  EXPECT_NEAR(std::abs(*toFloorPose(path.poses[2].pose)->heading_rad), kPi, 1e-12);
  EXPECT_EQ(path.poses[1].header.frame_id, "map");
}

TEST(NavigatorMessages, TheDeviationIsThatOfTheWorstDirection) {
  nav_msgs::Odometry odometry;
  // 0.3 m along a diagonal, 0.1 m across.
  odometry.pose.covariance[0] = odometry.pose.covariance[7] = 0.05;
  odometry.pose.covariance[1] = odometry.pose.covariance[6] = 0.04;
  EXPECT_NEAR(positionSigma(odometry), 0.3, 1e-9);
  odometry.pose.covariance[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isinf(positionSigma(odometry)));
}

}  // namespace
}  // namespace stereo_nav::nodes
