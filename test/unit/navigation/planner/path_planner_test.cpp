#include "navigation/planner/path_planner.h"

#include <gtest/gtest.h>

#include <random>

#include "stereo_nav/core/input_error.h"
#include "unit/navigation/planner/planner_scene.h"

namespace stereo_nav::navigation {
namespace {

const PlanarPose kContestStart{{0.55, 0.35}, 0.0};
const Eigen::Vector2d kContestGoal(4.3, 10.0);

TEST(PathPlanner, CrossesTheContestFieldWithItsWholeOutlineFree) {
  const grid::OccupancyGrid field = contestField();
  const PlannerParams params = contestRobot();
  PathPlanner planner(params);
  planner.setMap(field);
  const Plan plan = planner.plan(kContestStart, kContestGoal);
  ASSERT_EQ(plan.status, PlanStatus::kFound) << plan.text;
  EXPECT_EQ(plan.left_m, 0.0) << "the start is inside the circle of the robot, but its outline is free";
  EXPECT_LE(plan.poses.size(), 20U);
  EXPECT_LT((plan.poses.front().position_m - kContestStart.position_m).norm(), 1e-9);
  EXPECT_LT((plan.poses.back().position_m - kContestGoal).norm(), 1e-9);
  EXPECT_GE(leastDistance(field, params.makeFootprint(), plan.poses, params.heading), -1e-9);
  EXPECT_GT(plan.length_m, (kContestGoal - kContestStart.position_m).norm());
  EXPECT_LT(plan.length_m, 18.0);
}

TEST(PathPlanner, KeepsItsOutlineFreeInRandomRooms) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> place(0.2, 5.8), size(0.05, 0.6);
  int found = 0;
  for (int trial = 0; trial < 40; ++trial) {
    grid::OccupancyGrid map = freeMap(6.0, 6.0, 0.05);
    for (int i = 0; i < 12; ++i) {
      const double x = place(generator), y = place(generator);
      setBox(map, x, y, std::min(6.0, x + size(generator)), std::min(6.0, y + size(generator)));
    }
    PlannerParams params;
    params.footprint = "0.45 0.2 -0.25 0.25 -0.25 -0.25 0.45 -0.2";
    params.heading = trial % 2 == 0 ? HeadingRule::kTravel : HeadingRule::kKept;
    PathPlanner planner(params);
    planner.setMap(map, 0.3);
    const Plan plan =
        planner.plan({{place(generator), place(generator)}, 0.3}, {place(generator), place(generator)});
    if (!plan.found() || plan.left_m > 0.0) continue;
    ++found;
    EXPECT_GE(leastDistance(map, params.makeFootprint(), plan.poses, params.heading), -1e-6)
        << "trial " << trial;
  }
  EXPECT_GE(found, 10);
}

TEST(PathPlanner, FollowsAChangeOfTheMapAsIfItWereNew) {
  grid::OccupancyGrid field = contestField();
  for (const HeadingRule rule : {HeadingRule::kKept, HeadingRule::kTravel}) {
    PlannerParams params = contestRobot();
    params.heading = rule;
    PathPlanner followed(params), anew(params);
    followed.setMap(field);
    followed.update(field, setBox(field, 4.6, 2.0, 5.2, 2.4));
    followed.update(field, setBox(field, 2.4, 5.4, 3.2, 6.2, grid::kFree));
    anew.setMap(field);
    EXPECT_EQ(followed.space().moves().moves, anew.space().moves().moves);
    EXPECT_EQ(followed.space().moves().turns, anew.space().moves().turns);
    const PlanarPose start{{1.0, 1.0}, kPi / 2.0};
    const Plan a = followed.plan(start, kContestGoal), b = anew.plan(start, kContestGoal);
    ASSERT_TRUE(a.found());
    EXPECT_EQ(a.cost_m, b.cost_m);
    EXPECT_EQ(a.poses.size(), b.poses.size());
  }
}

TEST(PathPlanner, GoesRoundObstaclesInADistanceThatPays) {
  grid::OccupancyGrid map = freeMap(6.0, 6.0);
  setBox(map, 2.5, 0.0, 3.5, 3.0);
  PlannerParams params = contestRobot();
  params.clearance.weight = 0.0;
  PathPlanner shortest(params);
  shortest.setMap(map);
  params.clearance.weight = 2.0;
  PathPlanner clear(params);
  clear.setMap(map);
  const PlanarPose start{{1.0, 1.0}, 0.0};
  const Plan near = shortest.plan(start, {5.0, 1.0}), far = clear.plan(start, {5.0, 1.0});
  ASSERT_TRUE(near.found() && far.found());
  EXPECT_LT(near.clearance_m, 0.05);
  EXPECT_GT(far.clearance_m, 0.1);
  EXPECT_GT(far.length_m, near.length_m);
}

TEST(PathPlanner, TakesADoorThatOnlyItsOutlineFitsThrough) {
  grid::OccupancyGrid map = freeMap(6.0, 4.0);
  setBox(map, 3.0, 0.0, 3.1, 1.7);
  setBox(map, 3.0, 2.4, 3.1, 4.0);  // 0.7 m are left
  PlannerParams params;
  params.footprint_length_m = 1.2;  // its circle has 1.34 m
  params.footprint_width_m = 0.6;
  PathPlanner planner(params);
  planner.setMap(map);
  const Plan plan = planner.plan({{1.0, 2.0}, 0.0}, {5.0, 2.0});
  ASSERT_TRUE(plan.found()) << plan.text;
  EXPECT_GE(leastDistance(map, params.makeFootprint(), plan.poses, params.heading), -1e-9);
  params.footprint_width_m = 0.75;
  PathPlanner wide(params);
  wide.setMap(map);
  const Plan none = wide.plan({{1.0, 2.0}, 0.0}, {5.0, 2.0});
  EXPECT_EQ(none.status, PlanStatus::kNoWay);
  EXPECT_NE(none.text.find("wide enough"), std::string::npos) << none.text;
}

TEST(PathPlanner, LeavesObstaclesThatItTouchesAtTheStartAndSaysSo) {
  const grid::OccupancyGrid field = contestField();
  PathPlanner planner(contestRobot());
  planner.setMap(field);
  const Plan plan = planner.plan({{1.0, 3.75}, 0.0}, {1.0, 1.0});  // 0.25 m before the fence
  ASSERT_TRUE(plan.found()) << plan.text;
  EXPECT_NEAR(plan.left_m, 0.08, 0.03);
  EXPECT_NE(plan.text.find("touches an obstacle at the start"), std::string::npos) << plan.text;
  EXPECT_LT(plan.poses[1].position_m.y(), 3.7) << "straight away from it";
  EXPECT_NEAR(plan.poses[1].position_m.x(), 1.0, 0.03);
}

TEST(PathPlanner, SaysWhenNothingLeadsAwayFromObstacles) {
  grid::OccupancyGrid map = freeMap(4.0, 4.0);
  setBox(map, 1.0, 1.0, 3.0, 3.0);
  PathPlanner planner(contestRobot());
  planner.setMap(map);
  const Plan plan = planner.plan({{2.0, 2.0}, 0.0}, {0.4, 0.4});
  EXPECT_EQ(plan.status, PlanStatus::kStartBlocked);
  EXPECT_NE(plan.text.find("push it free"), std::string::npos) << plan.text;
}

TEST(PathPlanner, ReplacesAGoalThatIsNotFreeWithinTheTolerance) {
  const grid::OccupancyGrid field = contestField();
  PathPlanner planner(contestRobot());
  planner.setMap(field);
  const Plan moved = planner.plan({{1.0, 1.0}, 0.0}, {1.0, 3.8});
  ASSERT_EQ(moved.status, PlanStatus::kGoalMoved) << moved.text;
  EXPECT_NEAR((moved.poses.back().position_m - Eigen::Vector2d(1.0, 3.66)).norm(), 0.0, 0.03);
  EXPECT_NE(moved.text.find("the path ends there"), std::string::npos) << moved.text;
  const Plan refused = planner.plan({{1.0, 1.0}, 0.0}, {2.8, 5.8});  // inside of a box
  EXPECT_EQ(refused.status, PlanStatus::kGoalBlocked);
  EXPECT_FALSE(refused.found());
  EXPECT_NE(refused.text.find("the nearest point that it can reach is ("), std::string::npos) << refused.text;
}

TEST(PathPlanner, NamesAPlaceThatIsNotOnTheMap) {
  PathPlanner planner(contestRobot());
  planner.setMap(contestField());
  EXPECT_EQ(planner.plan({{-1.0, 1.0}, 0.0}, kContestGoal).status, PlanStatus::kOutside);
  EXPECT_EQ(planner.plan(kContestStart, {4.0, 12.0}).status, PlanStatus::kOutside);
}

TEST(PathPlanner, TreatsUnknownSpaceByItsOneRule) {
  grid::OccupancyGrid map = freeMap(6.0, 4.0);
  setBox(map, 2.8, 0.0, 3.2, 4.0, grid::kUnknown);
  PlannerParams params = contestRobot();
  PathPlanner careful(params);
  careful.setMap(map);
  EXPECT_EQ(careful.plan({{1.0, 2.0}, 0.0}, {5.0, 2.0}).status, PlanStatus::kNoWay);
  params.unknown = grid::UnknownSpace::kAsFree;
  PathPlanner bold(params);
  bold.setMap(map);
  EXPECT_EQ(bold.plan({{1.0, 2.0}, 0.0}, {5.0, 2.0}).status, PlanStatus::kFound);
}

TEST(PathPlanner, WorksOnAMapWhoseOriginIsTurned) {
  grid::OccupancyGrid field = contestField();
  PathPlanner plain(contestRobot());
  plain.setMap(field);
  field.geometry.origin_x_m = 3.0;
  field.geometry.origin_y_m = -2.0;
  field.geometry.origin_yaw_rad = 0.7;
  PathPlanner turned(contestRobot());
  turned.setMap(field, 0.7);
  const Eigen::Isometry2d T = field.geometry.T_map_grid();
  const Plan a = plain.plan(kContestStart, kContestGoal, 1.0);
  const Plan b = turned.plan({T * kContestStart.position_m, 0.7}, T * kContestGoal, 1.7);
  ASSERT_TRUE(a.found() && b.found());
  EXPECT_NEAR(a.length_m, b.length_m, 0.05) << "start and goal are at sides of cells";
  EXPECT_NEAR(b.poses[0].heading_rad, 0.7, 1e-9);
  EXPECT_NEAR(b.poses.back().heading_rad, 1.7, 1e-9);
}

TEST(PathPlanner, RefusesAFootprintThatCannotBe) {
  PlannerParams params;
  params.footprint = "1 1 2 1 2 2";
  EXPECT_THROW(PathPlanner{params}, InputError);
}

}  // namespace
}  // namespace stereo_nav::navigation
