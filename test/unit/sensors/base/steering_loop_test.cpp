#include "sensors/base/controller/steering_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sensors/base/emulation/emulated_wheel.h"

namespace stereo_nav::base {
namespace {

constexpr double kSteeringPeriod_s = 0.01;
constexpr double kUradPerRad = 1e6;

/// Those of docs/firmware/mega_base.
SteeringLoopGains steeringGains() {
  return {15.0F, 8.0F, 0.008F, {0.083F, 0.05F, 0.1F, 2.0F, 10.0F}};
}

EmulatedWheelParams steeredWheel() {
  EmulatedWheelParams params;
  params.steered = true;
  return params;
}

/// What an absolute sensor of 1024 steps tells of an axis.
std::uint16_t countsOf(double angle_rad) {
  const auto counts = static_cast<long>(std::floor(angle_rad / (2.0 * M_PI) * 1024.0));
  return static_cast<std::uint16_t>(((counts % 1024) + 1024) % 1024);
}

struct Turn {
  double beyond_rad = 0.0;  ///< overshoot
  double settled_s = 0.0;   ///< after which it stays within a degree
  double final_rad = 0.0;
  double last_duty = 0.0;
};

Turn turnTo(double target_rad, const EmulatedWheelParams& params, double duration_s) {
  SteeringLoop loop(steeringGains());
  EmulatedWheel wheel(params);
  TurnCounter counter;
  Turn turn;
  for (double t_s = 0.0; t_s < duration_s; t_s += kSteeringPeriod_s) {
    const std::int32_t measured = counter.angle_urad(countsOf(wheel.steering_rad()), 0, 1024);
    const auto target = static_cast<std::int32_t>(std::lround(kUradPerRad * target_rad));
    turn.last_duty = static_cast<double>(loop.step(target, measured, static_cast<float>(kSteeringPeriod_s)));
    EXPECT_LE(std::abs(turn.last_duty), 1.0);
    wheel.advance(0.0, turn.last_duty, kSteeringPeriod_s);
    const double error_rad = wheel.steering_rad() - target_rad;
    turn.beyond_rad = std::max(turn.beyond_rad, std::copysign(1.0, target_rad) * error_rad);
    if (std::abs(error_rad) > M_PI / 180.0) turn.settled_s = t_s;
  }
  turn.final_rad = wheel.steering_rad();
  return turn;
}

TEST(SteeringLoopTest, TurnsWithoutOvershootAndThenStandsWithoutCurrent) {
  for (const double target_rad : {0.1, M_PI / 2.0, -M_PI / 2.0, 3.0}) {
    const Turn turn = turnTo(target_rad, steeredWheel(), 3.0);
    EXPECT_NEAR(turn.final_rad, target_rad, M_PI / 180.0);
    EXPECT_LT(turn.beyond_rad, M_PI / 180.0) << target_rad;
    EXPECT_LT(turn.settled_s, std::abs(target_rad) / 8.0 + 0.35) << target_rad;
    EXPECT_EQ(turn.last_duty, 0.0) << target_rad;
  }
}

/// A tyre on carpet: eight times the friction that the feed-forward knows.
TEST(SteeringLoopTest, TheIntegralOvercomesMoreFrictionThanTheFeedForwardKnows) {
  EmulatedWheelParams stiff = steeredWheel();
  stiff.friction_duty = 0.4;
  const Turn turn = turnTo(1.0, stiff, 5.0);
  EXPECT_NEAR(turn.final_rad, 1.0, M_PI / 180.0);
  EXPECT_LT(turn.beyond_rad, 2.0 * M_PI / 180.0);
}

TEST(SteeringLoopTest, TheCounterOfTurnsWrapsAtThirtyTwoBits) {
  SteeringLoop loop(steeringGains());
  const std::int32_t highest = 2147483647;
  loop.step(highest, highest, 0.01F);
  // 0.1 rad further, beyond the largest number.
  const auto beyond = static_cast<std::int32_t>(static_cast<std::uint32_t>(highest) + 100000U);
  EXPECT_GT(loop.step(beyond, highest, 0.01F), 0.0F);
}

TEST(TurnCounterTest, CountsOnBeyondATurnInBothDirections) {
  for (const double sign : {1.0, -1.0}) {
    TurnCounter counter;
    for (double angle_rad = 0.0; angle_rad < 20.0; angle_rad += 0.5) {
      const std::int32_t found = counter.angle_urad(countsOf(sign * angle_rad), 0, 1024);
      EXPECT_NEAR(found, sign * kUradPerRad * angle_rad, 6136.0 + 1.0) << angle_rad;
    }
  }
}

TEST(TurnCounterTest, ItsZeroIsWhereTheWheelLooksForward) {
  TurnCounter forward, left, behind_zero;
  EXPECT_EQ(forward.angle_urad(700, 700, 1024), 0);
  EXPECT_NEAR(left.angle_urad((700 + 256) % 1024, 700, 1024), 1570796, 1);
  EXPECT_NEAR(behind_zero.angle_urad(700 - 256, 700, 1024), -1570796, 1);
}

}  // namespace
}  // namespace stereo_nav::base
