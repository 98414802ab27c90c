// The planner behind a map and a local grid, and the two grids, against places that are known.
#include "navigation/navigator/grid_route_planner.h"

#include <gtest/gtest.h>

#include "core/angles.h"
#include "navigation/navigator/grid_surroundings.h"
#include "unit/navigation/planner/planner_scene.h"

namespace stereo_nav::navigator {
namespace {

using Grid = std::shared_ptr<const grid::OccupancyGrid>;

Eigen::Isometry2d poseAt(double x_m, double y_m, double heading_rad = 0.0) {
  Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
  T.translation() = Eigen::Vector2d(x_m, y_m);
  T.rotate(heading_rad);
  return T;
}

/// A local grid of 4 x 4 m whose lower left corner is given, unseen but for a box.
Grid localGrid(double x_m, double y_m, double x0, double y0, double x1, double y1, std::int8_t value) {
  grid::OccupancyGrid local = navigation::freeMap(4.0, 4.0, 0.05);
  local.cells.assign(local.cells.size(), grid::kUnknown);
  navigation::setBox(local, x0 - x_m, y0 - y_m, x1 - x_m, y1 - y_m, value);
  local.geometry.origin_x_m = x_m;
  local.geometry.origin_y_m = y_m;
  return std::make_shared<const grid::OccupancyGrid>(local);
}

Grid shared(const grid::OccupancyGrid& map) {
  return std::make_shared<const grid::OccupancyGrid>(map);
}

double lengthOf(const Route& route) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < route.points_map.size(); ++i)
    length_m += (route.points_map[i] - route.points_map[i - 1]).norm();
  return length_m;
}

TEST(GridSurroundings, KnowsFreeOccupiedAndUnseenInTheFrameOfTheOdometry) {
  grid::OccupancyGrid grid = navigation::freeMap(2.0, 2.0, 0.1);
  navigation::setBox(grid, 1.0, 0.0, 1.2, 0.2);
  navigation::setBox(grid, 0.0, 1.0, 0.2, 1.2, grid::kUnknown);
  grid.geometry.origin_x_m = 3.0;
  grid.geometry.origin_y_m = -1.0;
  grid.geometry.origin_yaw_rad = 0.5 * kPi;  // columns run along +y, rows along -x
  const GridSurroundings surroundings(shared(grid));
  EXPECT_EQ(surroundings.at({2.9, 0.1}), Place::kOccupied);
  EXPECT_EQ(surroundings.at({2.9, 0.5}), Place::kFree);
  EXPECT_EQ(surroundings.at({1.9, -0.9}), Place::kUnseen);
  EXPECT_EQ(surroundings.at({3.1, 0.0}), Place::kUnseen) << "beyond the edge";
}

TEST(PlanningGrid, RemembersWhatWasSeenUntilItIsSeenFreeOrForgotten) {
  PlanningGrid planning;
  planning.setMap(navigation::freeMap(6.0, 6.0, 0.05));
  const grid::Cell place = planning.grid().geometry.cellAt({3.02, 3.02});
  const cv::Rect changed =
      planning.see(*localGrid(1.0, 1.0, 2.5, 2.5, 3.5, 3.5, grid::kOccupied), Eigen::Isometry2d::Identity());
  EXPECT_EQ(planning.grid().at(place), grid::kOccupied);
  EXPECT_EQ(changed, cv::Rect(50, 50, 20, 20));
  planning.see(*localGrid(1.0, 1.0, 2.5, 2.5, 3.5, 3.5, grid::kUnknown), Eigen::Isometry2d::Identity());
  EXPECT_EQ(planning.grid().at(place), grid::kOccupied) << "nobody looks there any more";
  planning.see(*localGrid(1.0, 1.0, 2.8, 2.8, 3.2, 3.2, grid::kFree), Eigen::Isometry2d::Identity());
  EXPECT_EQ(planning.grid().at(place), grid::kFree);
  const grid::Cell other = planning.grid().geometry.cellAt({2.6, 2.6});
  EXPECT_EQ(planning.grid().at(other), grid::kOccupied);
  planning.forgetSeen();
  EXPECT_EQ(planning.grid().at(other), grid::kFree);
}

TEST(PlanningGrid, AWallOfTheMapStaysAndUnknownPlacesThatAreSeenFreeBecomeFree) {
  grid::OccupancyGrid map = navigation::freeMap(6.0, 6.0, 0.05);
  navigation::setBox(map, 2.5, 2.5, 2.7, 3.5);
  navigation::setBox(map, 2.8, 2.5, 3.5, 3.5, grid::kUnknown);
  PlanningGrid planning;
  planning.setMap(map);
  planning.see(*localGrid(1.0, 1.0, 1.0, 1.0, 5.0, 5.0, grid::kFree), Eigen::Isometry2d::Identity());
  EXPECT_EQ(planning.grid().at(map.geometry.cellAt({2.6, 3.0})), grid::kOccupied);
  EXPECT_EQ(planning.grid().at(map.geometry.cellAt({3.2, 3.0})), grid::kFree);
}

TEST(PlanningGrid, PutsWhatIsSeenWhereMapToOdomSaysAlsoIntoLargerCells) {
  PlanningGrid planning;
  planning.setMap(navigation::freeMap(8.0, 8.0, 0.2));
  // A cell at (1, 0) in odom, which lies at (4, 2) in the map, turned to the left.
  planning.see(*localGrid(-1.0, -1.0, 1.0, 0.0, 1.05, 0.05, grid::kOccupied), poseAt(4.0, 2.0, 0.5 * kPi));
  EXPECT_EQ(planning.grid().at(planning.grid().geometry.cellAt({3.97, 3.02})), grid::kOccupied);
}

TEST(GridRoutePlanner, GoesAroundWhatIsSeenAndRemembersIt) {
  GridRoutePlanner planner{navigation::PlannerParams()};
  planner.setMap(shared(navigation::freeMap(8.0, 6.0, 0.05)));
  const Goal goal{{7.0, 3.0}, std::nullopt};
  const Route straight = planner.plan(poseAt(1.0, 3.0), goal);
  EXPECT_NEAR(lengthOf(straight), 6.0, 0.01);
  EXPECT_TRUE(planner.isFree(straight.points_map));

  planner.see(localGrid(1.0, 1.0, 3.0, 2.0, 3.2, 4.0, grid::kOccupied), Eigen::Isometry2d::Identity());
  EXPECT_FALSE(planner.isFree(straight.points_map));
  const Route around = planner.plan(poseAt(1.0, 3.0), goal);
  EXPECT_GT(lengthOf(around), 6.4);
  EXPECT_TRUE(planner.isFree(around.points_map));

  planner.see(localGrid(1.0, 1.0, 0.0, 0.0, 0.0, 0.0, grid::kUnknown), Eigen::Isometry2d::Identity());
  EXPECT_FALSE(planner.isFree(straight.points_map)) << "still remembered";
  planner.clear();
  EXPECT_TRUE(planner.isFree(straight.points_map));
  EXPECT_EQ(planner.plans(), 2);
}

TEST(GridRoutePlanner, SaysWhyThereIsNoWay) {
  GridRoutePlanner planner{navigation::PlannerParams()};
  grid::OccupancyGrid map = navigation::freeMap(8.0, 6.0, 0.05);
  navigation::setBox(map, 4.0, 0.0, 4.2, 6.0);
  planner.setMap(shared(map));
  const Route route = planner.plan(poseAt(1.0, 3.0), {{7.0, 3.0}, std::nullopt});
  EXPECT_TRUE(route.points_map.empty());
  EXPECT_NE(route.reason.find("no way that is wide enough"), std::string::npos) << route.reason;
}

TEST(GridRoutePlanner, WithoutAMapWhatIsNotSeenIsFree) {
  GridRoutePlanner planner{navigation::PlannerParams()};
  planner.setMap(nullptr);
  const Goal goal{{12.0, -3.0}, std::nullopt};
  EXPECT_NEAR(lengthOf(planner.plan(poseAt(0.0, 0.0), goal)), std::hypot(12.0, 3.0), 0.02);
  planner.see(localGrid(-2.0, -2.0, 1.0, -1.5, 1.2, 1.5, grid::kOccupied), Eigen::Isometry2d::Identity());
  EXPECT_GT(lengthOf(planner.plan(poseAt(0.0, 0.0), goal)), std::hypot(12.0, 3.0) + 0.1);
}

TEST(GridRoutePlanner, AGoalWhereTheRobotStandsHasAWayAtWhoseEndItCanTurn) {
  GridRoutePlanner planner{navigation::PlannerParams()};
  planner.setMap(shared(navigation::freeMap(8.0, 6.0, 0.05)));
  const Route route = planner.plan(poseAt(3.0, 3.0), {{3.0, 3.0}, kPi});
  ASSERT_EQ(route.points_map.size(), 2U);
  EXPECT_NEAR(lengthOf(route), 0.01, 1e-9);
}

TEST(GridRoutePlanner, KeepsToAGivenPathFromTheNearestPlaceAheadOn) {
  GridRoutePlanner planner{navigation::PlannerParams()};
  planner.setMap(shared(navigation::freeMap(8.0, 6.0, 0.05)));
  std::vector<Eigen::Vector2d> path;  // there and back, 0.5 m beside
  for (double x = 2.0; x < 6.01; x += 0.1) path.emplace_back(x, 2.0);
  for (double x = 6.0; x > 1.99; x -= 0.1) path.emplace_back(x, 2.5);
  planner.keepTo(path);
  const Goal goal{path.back(), std::nullopt};
  const Route whole = planner.plan(poseAt(1.0, 3.0), goal);
  EXPECT_NEAR(lengthOf(whole), std::hypot(1.0, 1.0) + 4.0 + 0.5 + 4.0, 0.05);
  EXPECT_TRUE(planner.isFree({path.begin() + 5, path.end()}));  // so far it has come
  const Route rest = planner.plan(poseAt(2.5, 2.3), goal);
  EXPECT_NEAR(lengthOf(rest), 0.3 + 3.5 + 0.5 + 4.0, 0.05) << "the way back is nearer, but it is not next";

  planner.see(localGrid(3.0, 1.0, 4.0, 1.8, 4.2, 2.2, grid::kOccupied), Eigen::Isometry2d::Identity());
  const Route blocked = planner.plan(poseAt(2.5, 2.0), goal);
  EXPECT_TRUE(blocked.points_map.empty());
  EXPECT_NE(blocked.reason.find("the given path is blocked"), std::string::npos) << blocked.reason;
}

}  // namespace
}  // namespace stereo_nav::navigator
