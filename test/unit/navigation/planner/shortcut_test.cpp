#include "navigation/planner/shortcut.h"

#include <gtest/gtest.h>

#include "navigation/planner/published_plan.h"
#include "unit/navigation/planner/planner_scene.h"

namespace stereo_nav::navigation {
namespace {

TEST(Bends, AreWhereThePathTurns) {
  const CellPath path{{0, 0}, {1, 0}, {2, 0}, {3, 1}, {4, 2}, {4, 3}};
  const CellPath bends = bendsOf(path);
  ASSERT_EQ(bends.size(), 4U);
  EXPECT_EQ(bends[1], Eigen::Vector2d(2, 0));
  EXPECT_EQ(bends[2], Eigen::Vector2d(4, 2));
}

TEST(Shortcuts, MakeAStraightWayAcrossFreeSpace) {
  PathPlanner planner(contestRobot());
  planner.setMap(freeMap(6.0, 6.0));
  const CellPath stairs{{60, 60}, {80, 60}, {80, 70}, {100, 70}, {120, 90}, {140, 90}};
  EXPECT_EQ(shortened(planner.space(), stairs, 0.0).size(), 2U);
}

/// How the published work thins its path: the more points it leaves out, the more of the corner it cuts.
TEST(Thinning, AsPublishedCutsCornersWhichShortcutsDoNot) {
  grid::OccupancyGrid map = freeMap(6.0, 6.0);
  setBox(map, 0.0, 2.0, 3.0, 4.0);
  const PlannerParams params = contestRobot();
  PathPlanner planner(params);
  planner.setMap(map);
  const PlanarPose start{{1.0, 1.0}, 0.0};
  const auto& space = planner.space();
  const GridPath cells =
      publishedPath(space.collisionsAlong({1.0, 0.0}), space.geometry().cellAt(start.position_m),
                    space.geometry().cellAt({1.0, 5.0}), {});
  ASSERT_TRUE(cells.found());
  CellPath path;
  for (const grid::Cell cell : cells.cells) path.emplace_back(cell.x + 0.5, cell.y + 0.5);
  const auto distance = [&](const CellPath& points) {
    return leastDistance(map, params.makeFootprint(), planner.describe(points, start).poses,
                         HeadingRule::kKept);
  };
  EXPECT_GE(distance(path), 0.0);
  EXPECT_LT(distance(thinnedAsPublished(path, 20)), -0.02);
  EXPECT_LT(distance(thinnedAsPublished(path, 40)), distance(thinnedAsPublished(path, 20)));
  EXPECT_GE(distance(shortened(space, path, 0.0)), 0.0);
}

TEST(Thinning, KeepsTheLastPoint) {
  EXPECT_EQ(thinnedAsPublished({{0, 0}, {1, 0}, {2, 0}, {3, 0}}, 2).size(), 3U);
  EXPECT_EQ(thinnedAsPublished({{0, 0}, {1, 0}, {2, 0}}, 2).size(), 2U);
  EXPECT_TRUE(thinnedAsPublished({}, 2).empty());
}

}  // namespace
}  // namespace stereo_nav::navigation
