#include "navigation/control/path_driver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angles.h"
#include "navigation/control/course_run.h"

namespace stereo_nav::control {
namespace {

ControlParams paramsFor(FollowLaw law) {
  ControlParams params;
  params.law = law;
  if (law == FollowLaw::kStanley) params.drive.wheelbase_m = 0.5;
  return params;
}

/// Runs the driver on its own drive for at most 40 s.
struct Drive {
  explicit Drive(const ControlParams& params) : params_(params), under_way_(params.drive) {}

  void run(PathDriver& driver, double most_s = 40.0) {
    for (const double end_s = time_s_ + most_s; time_s_ < end_s; time_s_ += params_.period_s) {
      const Twist command = driver.command(state, time_s_, time_s_);
      fastest = std::max(fastest, command.head<2>().norm());
      under_way_.add(time_s_, command);
      state = under_way_.predicted(state, time_s_, time_s_ + params_.period_s);
      if (driver.finished() && state.twist.norm() < 1e-3) return;
    }
  }

  DriveState state;
  double fastest = 0.0;

 private:
  ControlParams params_;
  CommandHistory under_way_;
  double time_s_ = 0.0;
};

TEST(GoalCheck, EachPartIsLatched) {
  GoalCheck check{GoalParams()};
  EXPECT_FALSE(check.update(0.1, 0.0));
  EXPECT_FALSE(check.update(0.01, 1.0));
  EXPECT_TRUE(check.positionReached());
  EXPECT_TRUE(check.update(0.1, 0.01));  // the position was reached before
  EXPECT_TRUE(check.update(1.0, 1.0));
}

TEST(PathDriver, TurnsOnTheSpotToAPathBehindItAndToTheGoalsHeading) {
  for (const FollowLaw law : {FollowLaw::kPursuit, FollowLaw::kHolonomic}) {
    const ControlParams params = paramsFor(law);
    PathDriver driver(params, Path({{0.0, 0.0}, {-2.0, 0.0}}), 0.5 * kPi);
    Drive drive(params);
    drive.run(driver);
    EXPECT_EQ(driver.phase(), DrivePhase::kArrived);
    EXPECT_LT((drive.state.T_world_base.translation() - Eigen::Vector2d(-2.0, 0.0)).norm(), 0.02);
    EXPECT_NEAR(drive.state.heading_rad(), 0.5 * kPi, 2.0 * kRadPerDeg);
  }
}

TEST(PathDriver, AHolonomicBaseStrafesWhereItIsToLookTowardsTheGoal) {
  ControlParams params = paramsFor(FollowLaw::kHolonomic);
  params.heading = HeadingMode::kTowardsGoal;
  PathDriver driver(params, Path({{0.0, 0.0}, {0.0, 1.0}}), 0.0);
  Drive drive(params);
  drive.run(driver);
  EXPECT_EQ(driver.phase(), DrivePhase::kArrived);
  EXPECT_LT((drive.state.T_world_base.translation() - Eigen::Vector2d(0.0, 1.0)).norm(), 0.02);
  EXPECT_NEAR(drive.state.heading_rad(), 0.0, 2.0 * kRadPerDeg);
}

TEST(PathDriver, StaysArrivedWhereTheOdometryMovesOnByItself) {
  const ControlParams params = paramsFor(FollowLaw::kPursuit);
  PathDriver driver(params, Path({{0.0, 0.0}, {1.0, 0.0}}));
  Drive drive(params);
  drive.run(driver);
  ASSERT_EQ(driver.phase(), DrivePhase::kArrived);
  drive.state.T_world_base.translation().x() += 0.1;
  EXPECT_EQ(driver.command(drive.state, 50.0, 50.0), Twist(Twist::Zero()));
  EXPECT_TRUE(driver.finished());
}

TEST(PathDriver, ADifferentialBaseBesideTheEndSaysThatItMissed) {
  const ControlParams params = paramsFor(FollowLaw::kPursuit);
  PathDriver driver(params, Path({{0.0, 0.0}, {0.3, 0.0}}));
  Drive drive(params);
  drive.state.T_world_base.translation().y() = 0.2;
  drive.run(driver);
  EXPECT_EQ(driver.phase(), DrivePhase::kMissed);
  EXPECT_LT(drive.state.twist.norm(), 1e-3);
}

TEST(PathDriver, AHolonomicBaseComesBackToItsPath) {
  const ControlParams params = paramsFor(FollowLaw::kHolonomic);
  PathDriver driver(params, Path({{0.0, 0.0}, {2.0, 0.0}}));
  Drive drive(params);
  drive.state.T_world_base.translation().y() = 0.2;
  drive.run(driver);
  EXPECT_EQ(driver.phase(), DrivePhase::kArrived);
  EXPECT_LT((drive.state.T_world_base.translation() - Eigen::Vector2d(2.0, 0.0)).norm(), 0.02);
}

TEST(PathDriver, DrivesNoFasterThanItIsLimitedTo) {
  const ControlParams params = paramsFor(FollowLaw::kPursuit);
  PathDriver driver(params, Path({{0.0, 0.0}, {1.0, 0.0}}));
  driver.limitSpeed(0.2);
  Drive drive(params);
  drive.run(driver);
  EXPECT_EQ(driver.phase(), DrivePhase::kArrived);
  EXPECT_LT(drive.fastest, 0.35);  // the lag is led by a little more at the start
  EXPECT_GT(drive.fastest, 0.19);
}

TEST(PathDriver, ALimitOfZeroStopsItAndItGoesOnAfterwards) {
  const ControlParams params = paramsFor(FollowLaw::kPursuit);
  PathDriver driver(params, Path({{0.0, 0.0}, {3.0, 0.0}}));
  Drive drive(params);
  drive.run(driver, 1.5);
  driver.limitSpeed(0.0);
  drive.run(driver, 2.0);
  EXPECT_LT(drive.state.twist.norm(), 1e-3);
  EXPECT_EQ(driver.phase(), DrivePhase::kFollowing);
  driver.limitSpeed(1.0);
  drive.run(driver);
  EXPECT_EQ(driver.phase(), DrivePhase::kArrived);
}

TEST(PathDriver, ThePathStaysWhereItIsInTheWorldWhenItsFrameJumps) {
  const ControlParams params = paramsFor(FollowLaw::kHolonomic);
  PathDriver driver(params, Path({{0.0, 0.0}, {3.0, 0.0}}));
  Drive drive(params);
  drive.run(driver, 1.5);
  Eigen::Isometry2d T_new_old = Eigen::Isometry2d::Identity();
  T_new_old.translate(Eigen::Vector2d(0.3, -0.2)).rotate(0.1);
  driver.reanchor(T_new_old);
  drive.state.T_world_base = T_new_old * drive.state.T_world_base;
  drive.run(driver);
  EXPECT_EQ(driver.phase(), DrivePhase::kArrived);
  const Eigen::Vector2d goal = T_new_old * Eigen::Vector2d(3.0, 0.0);
  EXPECT_LT((drive.state.T_world_base.translation() - goal).norm(), 0.02);
  EXPECT_NEAR(drive.state.heading_rad(), 0.1, 2.0 * kRadPerDeg);
}

}  // namespace
}  // namespace stereo_nav::control
