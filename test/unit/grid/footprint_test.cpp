#include "grid/footprint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "core/angles.h"
#include "grid/polygon_cells.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::grid {
namespace {

bool holds(const Polygon& polygon, const Eigen::Vector2d& p) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d side = polygon[(i + 1) % polygon.size()] - polygon[i], to = p - polygon[i];
    if (side.x() * to.y() - side.y() * to.x() < -1e-9) return false;
  }
  return true;
}

TEST(Footprint, OfARectangleHasItsRadii) {
  const Footprint robot = Footprint::rectangle(0.65, 0.65);
  EXPECT_NEAR(robot.inscribedRadius(), 0.325, 1e-12);
  EXPECT_NEAR(robot.circumscribedRadius(), 0.325 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(robot.corners().size(), 4U);
}

TEST(Footprint, FillsDents) {
  const Footprint robot({{1, 1}, {0.1, 0}, {1, -1}, {-1, -1}, {-1, 1}});
  EXPECT_EQ(robot.corners().size(), 4U);
}

TEST(Footprint, TurnsWithTheHeading) {
  const Polygon turned = Footprint::rectangle(2.0, 1.0).at({10.0, 20.0}, kPi / 2.0);
  for (const auto& corner : turned) {
    EXPECT_NEAR(std::fabs(corner.x() - 10.0), 0.5, 1e-12);
    EXPECT_NEAR(std::fabs(corner.y() - 20.0), 1.0, 1e-12);
  }
}

TEST(Footprint, SweepsAllThatItPasses) {
  const Footprint robot({{0.5, 0.2}, {-0.3, 0.3}, {-0.3, -0.3}, {0.5, -0.2}});
  const Eigen::Vector2d from(1.0, 1.0), to(3.0, 2.0);
  const Polygon swept = robot.sweptBy(from, to, 0.3);
  for (int i = 0; i <= 20; ++i)
    for (const auto& corner : robot.at(from + (to - from) * i / 20.0, 0.3)) EXPECT_TRUE(holds(swept, corner));
  const Polygon turning = robot.turning(from, 3.0, -2.8);  // the shorter way round, through 180 degrees
  EXPECT_TRUE(holds(turning, robot.at(from, kPi)[0]));
  EXPECT_FALSE(holds(turning, from + Eigen::Vector2d(0.4, 0.0))) << "the nose points the other way";
}

TEST(Footprint, RefusesWhatIsNoOutlineOfARobot) {
  EXPECT_THROW(Footprint({{0, 0}, {1, 0}}), InputError);
  EXPECT_THROW(Footprint({{-1, 0}, {0, 0}, {1, 0}}), InputError);
  EXPECT_THROW(Footprint({{1, 1}, {2, 1}, {2, 2}}), InputError);  // base_link outside
}

TEST(CellsOfAPolygon, AreAllThatItReachesInto) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> place(-6.0, 6.0);
  for (int trial = 0; trial < 50; ++trial) {
    Polygon points;
    for (int i = 0; i < 6; ++i) points.emplace_back(place(generator), place(generator));
    const Polygon polygon = convexHull(points);
    std::set<std::pair<int, int>> cells;
    for (const CellSpan& span : cellsOf(polygon))
      for (int x = span.left; x <= span.right; ++x) cells.insert({x, span.y});
    // Points inside, close together: each one's cell is there. And each cell is near such a point.
    std::set<std::pair<int, int>> seen;
    for (double y = -6.0; y <= 6.0; y += 0.02)
      for (double x = -6.0; x <= 6.0; x += 0.02)
        if (holds(polygon, {x, y}))
          seen.insert({static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y))});
    for (const auto& cell : seen) EXPECT_TRUE(cells.count(cell)) << cell.first << " " << cell.second;
    EXPECT_LE(cells.size(), seen.size() + 6) << "only cells that the polygon merely grazes may be unseen";
  }
}

TEST(CellsOfAPolygon, DoNotCountSidesThatOnlyTouch) {
  const auto spans = cellsOf({{1, 1}, {3, 1}, {3, 2}, {1, 2}});
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_TRUE((spans[0] == CellSpan{1, 1, 2}));
}

}  // namespace
}  // namespace stereo_nav::grid
