#include "sim/lamp_flicker.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stereo_nav::sim {
namespace {

TEST(LampFlicker, ComesAgainTwiceInEachPeriodOfTheMains) {
  for (const double mains_hz : {50.0, 60.0}) {
    const FlickerParams flicker{mains_hz, 0.3};
    const double period_s = 0.5 / mains_hz;
    for (double time_s = 0.0; time_s < 0.02; time_s += 0.0007) {
      const double light = lampLight(flicker, 0.4, time_s, 0.001);
      EXPECT_NEAR(light, lampLight(flicker, 0.4, time_s + period_s, 0.001), 1e-9);
      EXPECT_NEAR(light - 1.0, 1.0 - lampLight(flicker, 0.4, time_s + 0.5 * period_s, 0.001), 1e-9);
    }
    EXPECT_NEAR(lampLight(flicker, 0.0, 0.0, 0.0), 1.3, 1e-12);
  }
}

TEST(LampFlicker, AnExposureOfWholePeriodsDoesNotSeeIt) {
  const FlickerParams flicker{50.0, 0.3};
  for (double time_s = 0.0; time_s < 0.02; time_s += 0.0013) {
    EXPECT_NEAR(lampLight(flicker, 0.0, time_s, 0.010), 1.0, 1e-12);
    EXPECT_NEAR(lampLight(flicker, 0.0, time_s, 0.020), 1.0, 1e-12);
  }
  // Half a period more than two: the mean of half a wave, 2 / pi, over five half waves.
  EXPECT_NEAR(lampLight(flicker, 0.0, 0.0, 0.025), 1.0 + 0.3 * (2.0 / M_PI) / 5.0, 1e-9);
}

TEST(LampFlicker, SteadyLightIsOne) {
  EXPECT_EQ(lampLight(FlickerParams(), 1.0, 0.123, 0.02), 1.0);
}

}  // namespace
}  // namespace stereo_nav::sim
