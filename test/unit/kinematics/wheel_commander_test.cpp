#include "kinematics/wheel_commander.h"

#include <gtest/gtest.h>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "kinematics/layouts.h"

namespace stereo_nav::kinematics {
namespace {

DriveParams smallSwerve() {
  return swerveDrive({{0.2, 0.2}, {0.2, -0.2}, {-0.2, 0.2}, {-0.2, -0.2}}, 0.05);
}

WheelLimits fastMotors() {
  WheelLimits limits;
  limits.max_speed_m_per_s = 50.0;
  limits.max_acceleration_m_per_s2 = 1000.0;
  limits.max_steering_rate_rad_per_s = 1000.0;
  return limits;
}

/// Distance from the line after one metre straight while turning at pi rad/s.
double skewOfAMetre(double period_s, bool discretised) {
  Eigen::Isometry2d T_field_base = Eigen::Isometry2d::Identity();
  const int steps = static_cast<int>(std::lround(1.0 / period_s));
  for (int i = 0; i < steps; ++i) {
    const Twist wanted = fromField({1.0, 0.0, kPi}, kPi * period_s * i);
    const Twist held = discretised ? alongArc(wanted, period_s) : wanted;
    T_field_base = T_field_base * expPlanar(held * period_s);
  }
  return std::abs(T_field_base.translation().y());
}

TEST(AlongArc, keepsATurningRobotOnItsLine) {
  EXPECT_NEAR(skewOfAMetre(0.010, false), 0.0157, 1e-4);
  EXPECT_NEAR(skewOfAMetre(0.020, false), 0.0314, 1e-4);
  EXPECT_NEAR(skewOfAMetre(0.050, false), 0.079, 1e-3);
  EXPECT_LT(skewOfAMetre(0.020, true), 1e-3);
  EXPECT_LT(skewOfAMetre(0.050, true), 1e-3);
}

TEST(FromField, turnsWithTheBase) {
  EXPECT_LT((fromField({1.0, 0.0, 0.5}, 0.5 * kPi) - Twist(0.0, -1.0, 0.5)).norm(), 1e-12);
}

TEST(Desaturated, keepsTheDirection) {
  const Drive drive(smallSwerve());
  const Twist wanted(3.0, 1.0, 4.0);
  const Twist slower = desaturated(drive, wanted, 1.0);
  EXPECT_NEAR(slower.normalized().dot(wanted.normalized()), 1.0, 1e-12);
  double fastest = 0.0;
  for (const auto& wheel : drive.inverse(slower)) fastest = std::max(fastest, wheel.speed_m_per_s);
  EXPECT_NEAR(fastest, 1.0, 1e-12);
  EXPECT_EQ(desaturated(drive, {0.1, 0.0, 0.0}, 1.0), Twist(0.1, 0.0, 0.0));
}

TEST(LeastSteering, flipsBeyondNinetyDegrees) {
  const WheelState flipped = leastSteering({1.0, kRadPerDeg * 100.0}, 0.0);
  EXPECT_NEAR(flipped.steering_rad, kRadPerDeg * -80.0, 1e-12);
  EXPECT_EQ(flipped.speed_m_per_s, -1.0);
  const WheelState kept = leastSteering({1.0, kRadPerDeg * 90.0}, 0.0);
  EXPECT_NEAR(kept.steering_rad, kRadPerDeg * 90.0, 1e-12);
  EXPECT_EQ(kept.speed_m_per_s, 1.0);
  const WheelState continuous = leastSteering({1.0, kRadPerDeg * -170.0}, kRadPerDeg * 530.0);
  EXPECT_NEAR(continuous.steering_rad, kRadPerDeg * 550.0, 1e-12);
  EXPECT_EQ(continuous.speed_m_per_s, 1.0);
}

TEST(WheelCommander, holdsTheAnglesWhenIdle) {
  WheelCommander commander(smallSwerve(), fastMotors());
  commander.command({0.5, 0.5, 0.0}, 0.02);
  for (const auto& wheel : commander.command(Twist::Zero(), 0.02)) {
    EXPECT_EQ(wheel.speed_m_per_s, 0.0);
    EXPECT_NEAR(wheel.steering_rad, 0.25 * kPi, 1e-12);
  }
}

TEST(WheelCommander, doesNotPushAcrossItsWay) {
  WheelCommander commander(smallSwerve(), fastMotors());
  for (const auto& wheel : commander.command({0.0, 1.0, 0.0}, 0.02, {0.0, 0.0, 0.0, 0.0}))
    EXPECT_NEAR(wheel.speed_m_per_s, 0.0, 1e-9);
  const double off = kRadPerDeg * 60.0;
  for (const auto& wheel : commander.command({1.0, 0.0, 0.0}, 0.02, {off, off, off, off}))
    EXPECT_NEAR(wheel.speed_m_per_s, 0.5, 1e-9);
}

TEST(WheelCommander, limitsRates) {
  WheelLimits limits;
  limits.max_speed_m_per_s = 2.0;
  limits.max_acceleration_m_per_s2 = 5.0;
  limits.max_steering_rate_rad_per_s = 3.0;
  WheelCommander commander(smallSwerve(), limits);
  std::vector<WheelState> last(4);
  for (int i = 0; i < 200; ++i) {
    const auto wheels = commander.command(i < 100 ? Twist(1.0, 0.5, 2.0) : Twist(-0.5, 1.0, -1.0), 0.02);
    for (std::size_t w = 0; w < 4; ++w) {
      EXPECT_LE(std::abs(wheels[w].speed_m_per_s - last[w].speed_m_per_s), 0.1 + 1e-9);
      EXPECT_LE(std::abs(wheels[w].steering_rad - last[w].steering_rad), 0.06 + 1e-9);
    }
    last = wheels;
  }
  EXPECT_LT((Drive(smallSwerve()).forward(last).twist - alongArc({-0.5, 1.0, -1.0}, 0.02)).norm(), 1e-9);
}

TEST(WheelCommander, acceleratesFromRestAfterAHalt) {
  WheelLimits limits = fastMotors();
  limits.max_acceleration_m_per_s2 = 2.0;
  WheelCommander commander(differentialDrive(0.4, 0.05), limits);
  for (int i = 0; i < 10; ++i) commander.command({1.0, 0.0, 0.0}, 0.1);
  commander.halt();
  EXPECT_NEAR(commander.command({1.0, 0.0, 0.0}, 0.1)[0].speed_m_per_s, 0.2, 1e-9);
}

TEST(WheelCommander, acceleratesAllWheelsByOneFactor) {
  WheelLimits limits = fastMotors();
  limits.max_acceleration_m_per_s2 = 1.0;
  WheelCommander commander(omniDrive(3, 0.2, 0.0, 0.05), limits);
  const Twist wanted(1.0, 0.3, 0.0);
  const Twist reached = Drive(omniDrive(3, 0.2, 0.0, 0.05)).forward(commander.command(wanted, 0.02)).twist;
  EXPECT_NEAR(reached.normalized().dot(wanted.normalized()), 1.0, 1e-12);
  EXPECT_LT(reached.norm(), 0.05);
}

}  // namespace
}  // namespace stereo_nav::kinematics
