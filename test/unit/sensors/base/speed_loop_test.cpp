#include "sensors/base/controller/speed_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sensors/base/emulation/emulated_wheel.h"

namespace stereo_nav::base {
namespace {

constexpr float kPeriod_s = 0.01F;

SpeedLoopGains gains(float back_calculation) {
  return {0.5F, 0.05F, 1.5F, 3.0F, back_calculation};
}

/// What a wheel does that is told a speed at rest.
struct Response {
  double overshoot_m_per_s = 0.0;
  double settled_s = 0.0;  ///< after which it stays within 2 %
  double final_m_per_s = 0.0;
};

Response respond(SpeedLoop loop, EmulatedWheel wheel, float target_m_per_s, double duration_s) {
  Response response;
  for (double t_s = 0.0; t_s < duration_s; t_s += static_cast<double>(kPeriod_s)) {
    const float duty = loop.step(target_m_per_s, static_cast<float>(wheel.speed_m_per_s()), kPeriod_s);
    EXPECT_LE(std::abs(duty), 1.0F);
    wheel.advance(static_cast<double>(duty), 0.0, static_cast<double>(kPeriod_s));
    const double error = wheel.speed_m_per_s() - target_m_per_s;
    response.overshoot_m_per_s = std::max(response.overshoot_m_per_s, error);
    if (std::abs(error) > 0.02 * target_m_per_s) response.settled_s = t_s;
  }
  response.final_m_per_s = wheel.speed_m_per_s();
  return response;
}

EmulatedWheelParams strongWheel() {
  EmulatedWheelParams params;
  params.max_acceleration_m_per_s2 = 2.0;
  return params;
}

TEST(SpeedLoopTest, ReachesTheSpeedWithoutOvershootThoughTheTyreLimitsTheAcceleration) {
  const Response response = respond(SpeedLoop(gains(10.0F)), EmulatedWheel(strongWheel()), 0.9F, 3.0);
  EXPECT_NEAR(response.final_m_per_s, 0.9, 0.002);
  EXPECT_LT(response.overshoot_m_per_s, 0.02 * 0.9);
  EXPECT_LT(response.settled_s, 0.75) << "0.45 s at 2 m/s^2, and what the lag adds";
}

TEST(SpeedLoopTest, TheIntegralDoesNotWindUpAtTheLimitOfTheDuty) {
  EmulatedWheelParams blocked = strongWheel();
  blocked.max_acceleration_m_per_s2 = 1e-9;
  const auto afterBeingBlocked = [&](float back_calculation) {
    SpeedLoop loop(gains(back_calculation));
    EmulatedWheel held(blocked);
    for (int i = 0; i < 300; ++i)
      held.advance(static_cast<double>(loop.step(1.8F, 0.0F, kPeriod_s)), 0.0, 0.01);
    return respond(loop, EmulatedWheel(strongWheel()), 0.5F, 4.0).overshoot_m_per_s;
  };
  EXPECT_GT(afterBeingBlocked(0.0F), 0.3) << "without back-calculation";
  EXPECT_LT(afterBeingBlocked(10.0F), 0.05);
}

TEST(SpeedLoopTest, TheIntegralFindsALoadThatTheFeedForwardDoesNotKnow) {
  EmulatedWheelParams loaded = strongWheel();
  loaded.full_speed_m_per_s = 1.5;
  loaded.friction_duty = 0.15;
  EXPECT_NEAR(respond(SpeedLoop(gains(10.0F)), EmulatedWheel(loaded), 0.6F, 4.0).final_m_per_s, 0.6, 0.005);
}

TEST(SpeedLoopTest, AWheelThatStandsGetsNoCurrent) {
  SpeedLoop loop(gains(10.0F));
  for (int i = 0; i < 100; ++i) loop.step(0.5F, 0.0F, kPeriod_s);
  EXPECT_EQ(loop.step(0.0F, 0.01F, kPeriod_s), 0.0F);
  EXPECT_LT(loop.step(0.0F, 0.5F, kPeriod_s), 0.0F) << "one that rolls is braked";
}

}  // namespace
}  // namespace stereo_nav::base
