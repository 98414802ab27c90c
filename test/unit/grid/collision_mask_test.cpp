#include "grid/collision_mask.h"

#include <gtest/gtest.h>

#include "grid/footprint.h"
#include "grid/obstacle_rows.h"
#include "unit/grid/random_obstacles.h"

namespace stereo_nav::grid {
namespace {

const Eigen::Vector2d kCellCentre(0.5, 0.5);

/// An outline that is turned, and whose centre is not its own.
Polygon tiltedOutline() {
  return Footprint({{3.2, 1.1}, {-1.4, 2.0}, {-2.3, -1.7}, {2.1, -2.4}}).at(kCellCentre, 0.4);
}

TEST(CollisionMask, IsWhereTheShapeWouldTouchAnObstacle) {
  const auto obstacles = randomObstacles(50, 40, 0.02, 1);
  for (const bool outside : {true, false}) {
    CollisionMask mask(cellsOf(tiltedOutline()), outside);
    mask.assign(obstacles);
    ObstacleRows rows;
    rows.assign(obstacles, outside);
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 50; ++x) {
        Polygon placed = tiltedOutline();
        for (auto& corner : placed) corner += Eigen::Vector2d(x, y);
        EXPECT_EQ(mask.cells()(y, x) != 0, rows.anyIn(cellsOf(placed))) << x << " " << y << " " << outside;
      }
    }
  }
}

TEST(CollisionMask, FollowsChangesAsIfAllWereComputedAnew) {
  auto obstacles = randomObstacles(60, 50, 0.02, 2);
  CollisionMask followed(cellsOf(tiltedOutline()), true);
  followed.assign(obstacles);
  for (unsigned seed = 3; seed < 13; ++seed) {
    const cv::Rect changed(static_cast<int>(seed * 7 % 50), static_cast<int>(seed * 5 % 40), 9, 6);
    randomObstacles(9, 6, seed % 2 == 0 ? 0.0 : 0.2, seed).copyTo(obstacles(changed));
    const cv::Mat before = followed.cells().clone();
    const cv::Rect part = followed.update(obstacles, changed);
    CollisionMask anew(cellsOf(tiltedOutline()), true);
    anew.assign(obstacles);
    EXPECT_EQ(cv::countNonZero(followed.cells() != anew.cells()), 0) << seed;
    cv::Mat differs = followed.cells() != before;
    differs(part).setTo(0);
    EXPECT_EQ(cv::countNonZero(differs), 0) << "outside of the part that it names, seed " << seed;
  }
}

TEST(ObstacleRows, CountWhatIsBeyondTheEdgeAsTold) {
  ObstacleRows rows;
  const cv::Mat_<std::uint8_t> free(5, 5, std::uint8_t{0});
  rows.assign(free, true);
  EXPECT_TRUE(rows.anyIn(CellSpan{2, -1, 2}));
  EXPECT_TRUE(rows.anyIn(CellSpan{5, 1, 2}));
  EXPECT_FALSE(rows.anyIn(CellSpan{4, 0, 4}));
  rows.assign(free, false);
  EXPECT_FALSE(rows.anyIn(CellSpan{2, -1, 2}));
  EXPECT_FALSE(rows.anyIn(CellSpan{5, 1, 2}));
}

}  // namespace
}  // namespace stereo_nav::grid
