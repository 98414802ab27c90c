#include <gtest/gtest.h>

#include <cmath>

#include "core/angles.h"
#include "test_world.h"

namespace stereo_nav::navigator {
namespace {

control::DriveState at(double x_m, double y_m, double heading_rad = 0.0) {
  control::DriveState state;
  state.T_world_base.translate(Eigen::Vector2d(x_m, y_m)).rotate(heading_rad);
  return state;
}

TEST(ProgressWatch, TurningCountsAsProgress) {
  ProgressParams params;
  ProgressWatch turning(params), standing(params);
  turning.restart(0.0, at(0, 0).T_world_base);
  standing.restart(0.0, at(0, 0).T_world_base);
  bool turning_stuck = false, standing_stuck = false;
  for (double time_s = 0.0; time_s < 10.0; time_s += 0.1) {
    turning_stuck = turning_stuck || turning.stuck(time_s, at(0, 0, 0.2 * time_s).T_world_base);
    standing_stuck = standing_stuck || standing.stuck(time_s, at(0.01 * std::sin(time_s), 0).T_world_base);
  }
  EXPECT_FALSE(turning_stuck);
  EXPECT_TRUE(standing_stuck);
}

TEST(Recovery, HasAnOrderAndABound) {
  RecoveryParams params;
  params.most_rounds = 1;
  Recovery recovery(params, true);
  EXPECT_EQ(recovery.next(), RecoveryStep::kClear);
  EXPECT_EQ(recovery.next(), RecoveryStep::kBackOff);
  EXPECT_EQ(recovery.next(), RecoveryStep::kTurn);
  EXPECT_FALSE(recovery.next());
  recovery.reset();
  EXPECT_EQ(recovery.next(), RecoveryStep::kClear);
  Recovery car(params, false);
  car.next();
  car.next();
  EXPECT_FALSE(car.next());
}

TEST(Trail, LeadsBackTheWayThatTheBaseCame) {
  Trail trail(3.0);
  for (int i = 0; i <= 100; ++i) trail.add({0.02 * i, 0.0});
  for (int i = 1; i <= 50; ++i) trail.add({2.0, 0.02 * i});
  const auto back = trail.back(1.5);
  EXPECT_LT((back.front() - Eigen::Vector2d(2.0, 1.0)).norm(), 1e-9);
  EXPECT_LT((back.back() - Eigen::Vector2d(1.5, 0.0)).norm(), 0.03);
}

TEST(Trail, ForgetsTheWayWhenTheOdometryIsSetAnew) {
  Trail trail(3.0);
  for (int i = 0; i <= 100; ++i) EXPECT_FALSE(trail.add({0.02 * i, 0.0}));
  EXPECT_TRUE(trail.add({0.0, 0.0}));
  EXPECT_EQ(trail.back(1.5).size(), 1U);
  EXPECT_FALSE(trail.add({0.05, 0.0}));
}

TEST(ReverseDriver, BacksOffAlongACurve) {
  const control::ControlParams params;
  std::vector<Eigen::Vector2d> points;  // to the base at the origin it came on a circle of 1 m
  for (int i = 0; i <= 50; ++i) points.emplace_back(-std::sin(0.02 * i), 1.0 - std::cos(0.02 * i));
  ReverseDriver driver(params, points, 0.2);
  control::CommandHistory under_way(params.drive);
  control::DriveState state;
  double time_s = 0.0;
  for (; time_s < 20.0 && !driver.finished(); time_s += 0.02) {
    under_way.add(time_s, driver.command(state, time_s, time_s));
    state = under_way.predicted(state, time_s, time_s + 0.02);
  }
  EXPECT_TRUE(driver.finished());
  EXPECT_LT((state.T_world_base.translation() - points.back()).norm(), 0.03);
}

TEST(MotionCheck, LetsTheBaseStopBeforeWhatIsInItsWay) {
  const control::DriveModelParams drive;
  const MotionCheck check({}, drive);
  TestWorld world;
  world.boxes.push_back({1.0, -1.0, 1.2, 1.0});
  const Twist ahead(0.6, 0.0, 0.0);
  EXPECT_DOUBLE_EQ(check.check(at(-1.0, 0.0), ahead, world).share, 1.0);
  const double near = check.check(at(0.4, 0.0), ahead, world).share;
  EXPECT_GT(near, 0.0);
  EXPECT_LT(near, 1.0);
  EXPECT_DOUBLE_EQ(check.check(at(0.69, 0.0), ahead, world).share, 0.0);
  EXPECT_DOUBLE_EQ(check.check(at(0.69, 0.0), -ahead, world).share, 1.0);
}

TEST(MotionCheck, ABaseThatTouchesSomethingMayLeaveButNotPush) {
  const control::DriveModelParams drive;
  const MotionCheck check({}, drive);
  TestWorld world;
  world.boxes.push_back({0.24, -1.0, 0.6, 1.0});
  EXPECT_DOUBLE_EQ(check.check(at(0.0, 0.0), {0.2, 0.0, 0.0}, world).share, 0.0);
  EXPECT_GT(check.check(at(0.0, 0.0), {-0.2, 0.0, 0.0}, world).share, 0.0);
}

TEST(MotionCheck, DoesNotStrafeOrReverseWhereNothingWasSeen) {
  const control::DriveModelParams drive;
  TestWorld world;
  world.seen = [](const Eigen::Vector2d& p) { return std::abs(p.y()) < 0.5 * (p.x() + 0.2); };  // ahead alone
  const MotionCheck check({}, drive);
  EXPECT_GT(check.check(at(0.8, 0.0), {0.3, 0.0, 0.0}, world).share, 0.0);
  const auto left = check.check(at(0.0, 0.0), {0.0, 0.4, 0.0}, world);
  EXPECT_DOUBLE_EQ(left.share, 0.0);
  EXPECT_TRUE(left.by_unseen);
  EXPECT_DOUBLE_EQ(check.check(at(0.0, 0.0), {-0.4, 0.0, 0.0}, world).share, 0.0);
  EXPECT_DOUBLE_EQ(check.check(at(0.0, 0.0), {0.0, 0.0, 1.0}, world).share, 1.0);  // it may turn to look
  MotionCheckParams anywhere;
  anywhere.into_unseen = true;
  EXPECT_DOUBLE_EQ(MotionCheck(anywhere, drive).check(at(0.0, 0.0), {0.0, 0.4, 0.0}, world).share, 1.0);
}

/// Nothing is seen nearer than 0.9 m, and a box at 0.6 m was seen before.
TEST(MotionCheck, CrossesItsBlindZoneOnlyForwardAndWhereNothingWasSeen) {
  const control::DriveModelParams drive;
  TestWorld world;
  world.seen = [](const Eigen::Vector2d& p) { return p.x() > 0.9; };
  EXPECT_DOUBLE_EQ(MotionCheck({}, drive).check(at(0.0, 0.0), {0.1, 0.0, 0.0}, world).share, 0.0)
      << "nor does it creep over unseen ground";
  MotionCheckParams params;
  params.blind_zone_m = 1.0;
  const MotionCheck check(params, drive);
  EXPECT_DOUBLE_EQ(check.check(at(0.0, 0.0), {0.4, 0.0, 0.0}, world).share, 1.0);
  EXPECT_DOUBLE_EQ(check.check(at(0.0, 0.0), {-0.4, 0.0, 0.0}, world).share, 0.0);
  EXPECT_DOUBLE_EQ(check.check(at(0.0, 0.0), {0.0, 0.4, 0.0}, world).share, 0.0);
  world.boxes = {{0.5, -0.2, 0.7, 0.2}};
  EXPECT_LT(check.check(at(0.0, 0.0), {0.4, 0.0, 0.0}, world).share, 1.0);
}

}  // namespace
}  // namespace stereo_nav::navigator
