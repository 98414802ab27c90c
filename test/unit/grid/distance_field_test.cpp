#include "grid/distance_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/grid/random_obstacles.h"

namespace stereo_nav::grid {
namespace {

double nearestObstacle(const cv::Mat_<std::uint8_t>& obstacles, int x, int y) {
  double least = std::numeric_limits<double>::infinity();
  for (int v = 0; v < obstacles.rows; ++v)
    for (int u = 0; u < obstacles.cols; ++u)
      if (obstacles(v, u) != 0) least = std::min(least, std::hypot(u - x, v - y));
  return least;
}

TEST(DistanceField, IsTheDistanceToTheNearestObstacleUpToItsReach) {
  const auto obstacles = randomObstacles(40, 30, 0.01, 1);
  DistanceField field(6);
  field.assign(obstacles);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      EXPECT_NEAR(field.cells()(y, x), std::min(6.0, nearestObstacle(obstacles, x, y)), 1e-4)
          << x << " " << y;
}

TEST(DistanceField, IsItsReachWhereThereAreNoObstacles) {
  DistanceField field(6);
  field.assign(cv::Mat_<std::uint8_t>(10, 10, std::uint8_t{0}));
  EXPECT_EQ(cv::countNonZero(field.cells() != 6.0F), 0);
}

TEST(DistanceField, FollowsChangesAsIfAllWereComputedAnew) {
  auto obstacles = randomObstacles(60, 50, 0.02, 2);
  DistanceField followed(8);
  followed.assign(obstacles);
  for (unsigned seed = 3; seed < 13; ++seed) {
    const cv::Rect changed(static_cast<int>(seed * 7 % 50), static_cast<int>(seed * 5 % 40), 9, 6);
    randomObstacles(9, 6, seed % 2 == 0 ? 0.0 : 0.2, seed).copyTo(obstacles(changed));
    followed.update(obstacles, changed);
    DistanceField anew(8);
    anew.assign(obstacles);
    EXPECT_EQ(cv::norm(followed.cells(), anew.cells(), cv::NORM_INF), 0.0) << seed;
  }
}

}  // namespace
}  // namespace stereo_nav::grid
