// The navigator in a closed loop with the drive's model, in a room of boxes.
#include "navigation/navigator/navigator.h"

#include <gtest/gtest.h>

#include <random>

#include "core/angles.h"
#include "test_world.h"

namespace stereo_nav::navigator {
namespace {

double distanceTo(const ClosedLoop& loop, double x_m, double y_m) {
  return (loop.state.T_world_base.translation() - Eigen::Vector2d(x_m, y_m)).norm();
}

bool says(const ClosedLoop& loop, const std::string& text) {
  return loop.navigator.words().find(text) != std::string::npos;
}

TEST(Navigator, DrivesToAGoalAndItsHeading) {
  for (const auto law : {control::FollowLaw::kPursuit, control::FollowLaw::kHolonomic}) {
    NavigatorParams params;
    params.control.law = law;
    ClosedLoop loop(params);
    loop.world.boxes.push_back({1.0, -1.0, 1.5, 1.0});
    loop.navigator.setGoal({{3.0, 0.0}, 0.5 * kPi});
    loop.run(60.0);
    EXPECT_EQ(loop.navigator.mode(), NavigatorMode::kArrived) << loop.navigator.words();
    EXPECT_LT(distanceTo(loop, 3.0, 0.0), 0.05);
    EXPECT_NEAR(loop.state.heading_rad(), 0.5 * kPi, 2.0 * kRadPerDeg);
    EXPECT_FALSE(loop.touched_in_motion);
  }
}

TEST(Navigator, ABoxThatIsPutInTheWayIsDrivenAround) {
  ClosedLoop loop;
  loop.planner.surprise = 0;
  loop.world.boxes.push_back({1.5, -0.6, 1.9, 0.6});
  loop.navigator.setGoal({{4.0, 0.0}, std::nullopt});
  loop.run(0.5);
  EXPECT_EQ(loop.planner.plans, 1);
  loop.run(60.0);
  EXPECT_EQ(loop.navigator.mode(), NavigatorMode::kArrived) << loop.navigator.words();
  EXPECT_LT(distanceTo(loop, 4.0, 0.0), 0.05);
  EXPECT_FALSE(loop.touched_in_motion);
}

TEST(Navigator, ADeadEndIsANamedFailureAfterABoundedTime) {
  ClosedLoop loop;
  loop.planner.surprise = 0;
  loop.world.boxes.push_back({2.0, -5.0, 2.3, 5.0});  // a wall where the map was free
  loop.navigator.setGoal({{4.0, 0.0}, std::nullopt});
  loop.run(180.0);
  EXPECT_EQ(loop.navigator.mode(), NavigatorMode::kFailed) << loop.navigator.words();
  EXPECT_TRUE(says(loop, "no way to the goal is free")) << loop.navigator.words();
  EXPECT_TRUE(says(loop, "tried")) << loop.navigator.words();
  EXPECT_GT(loop.planner.cleared, 0);
  EXPECT_FALSE(loop.touched_in_motion);
}

TEST(Navigator, WaitsForSomebodyWhoStandsBeforeItAndGoesOnAfterwards) {
  ClosedLoop loop;
  loop.planner.surprise = 0;
  loop.navigator.setGoal({{4.0, 0.0}, std::nullopt});
  loop.run(2.0);
  const double x_m = loop.state.T_world_base.translation().x();
  ASSERT_GT(loop.state.twist.x(), 0.5);
  loop.world.boxes.push_back({x_m + 1.2, -5.0, x_m + 1.5, 5.0});  // leaves no way around
  loop.run(1.5);
  EXPECT_LT(loop.state.twist.norm(), 0.25);
  EXPECT_FALSE(loop.touched_in_motion);
  loop.world.boxes.clear();
  loop.run(60.0);
  EXPECT_EQ(loop.navigator.mode(), NavigatorMode::kArrived) << loop.navigator.words();
  EXPECT_FALSE(loop.touched_in_motion);
}

TEST(Navigator, APlanThroughABoxIsNotFollowedIntoIt) {
  ClosedLoop loop;
  loop.planner.blind = true;
  loop.world.boxes.push_back({2.0, -1.0, 2.5, 1.0});
  loop.navigator.setGoal({{4.0, 0.0}, std::nullopt});
  loop.run(180.0);
  EXPECT_EQ(loop.navigator.mode(), NavigatorMode::kFailed);
  EXPECT_TRUE(says(loop, "the way is blocked")) << loop.navigator.words();
  EXPECT_FALSE(loop.touched_in_motion);
}

TEST(Navigator, ABaseThatDoesNotMoveIsStuckAndSaysSo) {
  ClosedLoop loop;
  loop.wheels_blocked = true;
  loop.navigator.setGoal({{3.0, 0.0}, std::nullopt});
  loop.run(180.0);
  EXPECT_EQ(loop.navigator.mode(), NavigatorMode::kFailed);
  EXPECT_TRUE(says(loop, "the base does not move")) << loop.navigator.words();
}

/// What is missing makes the command zero within 0.3 s, is named, and the base goes on when it is back.
struct Missing {
  const char* name;
  void (*change)(Situation&);
  const char* words;
};

class NavigatorStops : public testing::TestWithParam<Missing> {};

TEST_P(NavigatorStops, WithinThreeTenthsOfASecondAndGoesOn) {
  ClosedLoop loop;
  loop.navigator.setGoal({{4.0, 0.0}, std::nullopt});
  loop.run(2.0);
  ASSERT_GT(loop.state.twist.x(), 0.5);
  const double stamp_s = loop.time_s - 0.02;
  const auto change = [&](Situation& situation) {
    Situation changed = situation;
    GetParam().change(changed);
    if (changed.odometry_stamp_s < 0.0) changed.odometry_stamp_s = stamp_s;
    if (changed.surroundings_stamp_s < 0.0) changed.surroundings_stamp_s = stamp_s;
    situation = changed;
  };
  loop.run(0.3, change);
  EXPECT_EQ(loop.command, Twist(Twist::Zero())) << GetParam().name;
  loop.run(5.0, change);
  EXPECT_TRUE(says(loop, GetParam().words)) << loop.navigator.words();
  EXPECT_LT(loop.state.twist.norm(), 1e-3);
  loop.run(60.0);
  EXPECT_EQ(loop.navigator.mode(), NavigatorMode::kArrived) << loop.navigator.words();
  EXPECT_LT(distanceTo(loop, 4.0, 0.0), 0.05);
}

INSTANTIATE_TEST_SUITE_P(
    Each, NavigatorStops,
    testing::Values(
        Missing{"localisation", [](Situation& now) { now.localisation_lost = true; }, "localisation is lost"},
        Missing{"covariance", [](Situation& now) { now.position_sigma_m = 1.0; }, "known to 1.00 m only"},
        Missing{"odometry", [](Situation& now) { now.odometry_stamp_s = -1.0; }, "no odometry for"},
        Missing{"grid", [](Situation& now) { now.surroundings_stamp_s = -1.0; }, "the local grid is"},
        Missing{"no_grid", [](Situation& now) { now.surroundings = nullptr; }, "no local grid"}),
    [](const auto& test_info) { return std::string(test_info.param.name); });

TEST(Navigator, SlowsDownAsThePositionBecomesUncertain) {
  ClosedLoop loop;
  loop.navigator.setGoal({{4.0, 0.0}, std::nullopt});
  loop.run(2.5, [](Situation& situation) { situation.position_sigma_m = 0.3; });
  EXPECT_LT(loop.state.twist.x(), 0.55);
  EXPECT_GT(loop.state.twist.x(), 0.3);
}

TEST(Navigator, AfterAJumpOfTheMapItArrivesAtTheGoalInTheMap) {
  for (const double jump_m : {0.05, 0.5}) {
    ClosedLoop loop;
    loop.navigator.setGoal({{3.0, 0.0}, 0.0});
    loop.run(1.5);
    loop.world.T_world_odom.translate(Eigen::Vector2d(0.0, jump_m));
    loop.state.T_world_base.pretranslate(Eigen::Vector2d(0.0, jump_m));  // odom goes on as it was
    loop.run(60.0);
    EXPECT_EQ(loop.navigator.mode(), NavigatorMode::kArrived) << loop.navigator.words();
    EXPECT_LT(distanceTo(loop, 3.0, 0.0), 0.05) << jump_m;
  }
}

/// Eight boxes, half of them not on the map, and ten goals in free places.
struct FurnishedRoom {
  explicit FurnishedRoom(unsigned seed) : random(seed) {
    while (loop.world.boxes.size() < 8) {
      const Eigen::Vector2d p = place();
      const Box box{p.x(), p.y(), p.x() + 0.6, p.y() + 0.4};
      if (!box.contains({0.0, 0.0}, 0.6)) loop.world.boxes.push_back(box);
    }
    loop.planner.surprise = 4;
  }

  Eigen::Vector2d place() {
    std::uniform_real_distribution<double> coordinate(-4.4, 4.4);
    const double x_m = coordinate(random);
    return {x_m, coordinate(random)};
  }
  Eigen::Vector2d freePlace() {
    for (;;) {
      const Eigen::Vector2d p = place();
      bool free = true;
      for (const Box& box : loop.world.boxes) free = free && !box.contains(p, 0.6);
      if (free) return p;
    }
  }

  std::mt19937 random;
  ClosedLoop loop;
};

TEST(Navigator, InFurnishedRoomsItReachesItsGoalsAndTouchesNothing) {
  int goals = 0, reached = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    FurnishedRoom room(seed);
    for (int i = 0; i < 10; ++i) {
      const Eigen::Vector2d goal = room.freePlace();
      room.loop.navigator.setGoal({goal, std::nullopt});
      room.loop.run(180.0);
      const bool arrived = room.loop.navigator.mode() == NavigatorMode::kArrived;
      ++goals;
      if (arrived && distanceTo(room.loop, goal.x(), goal.y()) < 0.05) ++reached;
      if (!arrived) {
        EXPECT_EQ(room.loop.navigator.mode(), NavigatorMode::kFailed)
            << seed << " " << i << room.loop.navigator.words();
      }
    }
    EXPECT_FALSE(room.loop.touched_in_motion) << seed;
  }
  EXPECT_GE(reached, 98 * goals / 100);
}

TEST(Navigator, AGoalThatIsGivenUpStopsTheBase) {
  ClosedLoop loop;
  loop.navigator.setGoal({{4.0, 0.0}, std::nullopt});
  loop.run(1.5);
  loop.navigator.cancel();
  loop.run(3.0);
  EXPECT_EQ(loop.navigator.mode(), NavigatorMode::kIdle);
  EXPECT_LT(loop.state.twist.norm(), 1e-3);
}

}  // namespace
}  // namespace stereo_nav::navigator
