#include "navigation/control/speed_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angles.h"
#include "kinematics/layouts.h"

namespace stereo_nav::control {
namespace {

Path straight(double length_m) {
  return Path({{0.0, 0.0}, {length_m, 0.0}});
}

Path circle(double radius_m) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i <= 1000; ++i) {
    const double angle = 2.0 * kPi * i / 1000;
    points.emplace_back(radius_m * std::sin(angle), radius_m * (1.0 - std::cos(angle)));
  }
  return Path(points);
}

SpeedLimits fastLimits() {
  SpeedLimits limits;
  limits.max_speed_m_per_s = 5.0;
  limits.max_turn_acceleration_rad_per_s2 = 100.0;
  limits.max_turn_rate_rad_per_s = 50.0;
  limits.end_gain_per_s = 20.0;
  return limits;
}

TEST(PathSpeedProfile, BrakingSufficesForTheEnd) {
  const PathSpeedProfile profile(straight(10.0), fastLimits());
  EXPECT_DOUBLE_EQ(profile.limit(0.0), 5.0);
  EXPECT_NEAR(profile.limit(9.0), std::sqrt(2.0 * 1.5 * 1.0), 1e-6);
  EXPECT_DOUBLE_EQ(profile.limit(10.0), 0.0);
}

TEST(PathSpeedProfile, NearTheEndTheSpeedFallsWithTheDistance) {
  SpeedLimits limits;
  limits.end_gain_per_s = 3.0;
  EXPECT_NEAR(PathSpeedProfile(straight(10.0), limits).limit(9.99), 0.03, 1e-9);
}

TEST(PathSpeedProfile, ACurveIsTakenWithTheLateralAcceleration) {
  const PathSpeedProfile profile(circle(2.0), fastLimits());
  EXPECT_NEAR(profile.limit(2.0 * kPi), std::sqrt(1.5 * 2.0), 0.02);
}

TEST(PathSpeedProfile, ACurveIsTakenWithTheTurningRate) {
  SpeedLimits limits = fastLimits();
  limits.max_turn_rate_rad_per_s = 0.5;
  EXPECT_NEAR(PathSpeedProfile(circle(2.0), limits).limit(2.0 * kPi), 1.0, 0.01);
}

TEST(PathSpeedProfile, TheOuterWheelDoesNotExceedItsSpeed) {
  // On a circle of 2 m the outer wheel of a track of 1 m rolls 1.25 times as fast as the middle.
  const WheelSpeedLimit wheels{kinematics::Drive(kinematics::differentialDrive(1.0, 0.05)), 1.0};
  const PathSpeedProfile profile(circle(2.0), fastLimits(), wheels);
  EXPECT_NEAR(profile.limit(2.0 * kPi), 1.0 / 1.25, 0.01);
}

TEST(PathSpeedProfile, ItSlowsDownBeforeACorner) {
  SpeedLimits limits = fastLimits();
  const PathSpeedProfile profile(Path({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}}), limits);
  const double in_corner = profile.limit(4.0);
  EXPECT_LT(in_corner, 0.5);
  for (double arc_m = 0.0; arc_m < 3.9; arc_m += 0.01) {
    const double drop = std::pow(profile.limit(arc_m), 2) - std::pow(profile.limit(arc_m + 0.01), 2);
    EXPECT_LE(drop, 2.0 * limits.max_braking_m_per_s2 * 0.01 + 1e-9) << arc_m;
  }
}

TEST(SpeedGovernor, AcceleratesWithinItsLimitAndReachesTheSpeed) {
  SpeedLimits limits;
  SpeedGovernor governor(limits);
  EXPECT_NEAR(governor.next(1.0, 0.1), 0.15, 1e-12);
  EXPECT_NEAR(governor.acceleration(), 1.5, 1e-12);
  for (int i = 0; i < 10; ++i) governor.next(1.0, 0.1);
  EXPECT_DOUBLE_EQ(governor.speed_m_per_s(), 1.0);
  EXPECT_GT(governor.next(0.0, 0.1), 0.75);  // brakes, too, within its limit
}

}  // namespace
}  // namespace stereo_nav::control
