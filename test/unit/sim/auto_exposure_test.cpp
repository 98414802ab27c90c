#include "sim/auto_exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/exposure_plan.h"

namespace stereo_nav::sim {
namespace {

/// Grey level of a plain image: a linear camera of which `light` makes 1 grey level per ms of exposure.
double greyOf(double light, const ExposureSetting& setting) {
  return std::min(255.0, light * setting.exposure_ms * setting.gain);
}

/// Grey levels of the images after the light has changed from `before` to `after`.
std::vector<double> stepResponse(const AutoExposureParams& params, double before, double after) {
  AutoExposure loop(params, 25.0, 1.0);
  for (int i = 0; i < 200; ++i) loop.see(greyOf(before, loop.setting()));
  std::vector<double> greys;
  for (int i = 0; i < 60; ++i) {
    greys.push_back(greyOf(after, loop.setting()));
    loop.see(greys.back());
  }
  return greys;
}

TEST(AutoExposure, AStepOfLightIsCorrectedAfterADelayWithOvershoot) {
  const AutoExposureParams params;
  const std::vector<double> greys = stepResponse(params, 4.0, 16.0);  // two stops more
  // Three images are taken with settings from before the step.
  for (int i = 0; i < 3; ++i) EXPECT_GT(greys[static_cast<std::size_t>(i)], 2.0 * params.target);
  const double darkest = *std::min_element(greys.begin(), greys.end());
  EXPECT_LT(darkest, 0.85 * params.target);  // it goes too far ...
  EXPECT_GT(darkest, 0.4 * params.target);
  for (std::size_t i = 25; i < greys.size(); ++i) {  // ... and has come back after less than a second
    EXPECT_NEAR(std::log2(greys[i] / params.target), 0.0, params.tolerance_stops + 1.0 / 16.0) << i;
    EXPECT_EQ(greys[i], greys.back()) << i;
  }
}

TEST(AutoExposure, WithoutDelayItDoesNotOvershoot) {
  AutoExposureParams params;
  params.delay_images = 0;
  params.tolerance_stops = 0.0;
  for (const double grey : stepResponse(params, 4.0, 16.0)) EXPECT_GT(grey, params.target / 1.05);
}

TEST(AutoExposure, SmallChangesAreLeftAlone) {
  const AutoExposureParams params;
  const std::vector<double> greys = stepResponse(params, 10.0, 10.5);
  for (const double grey : greys) EXPECT_EQ(grey, greys.front());
}

TEST(AutoExposure, ExposureComesBeforeGainAndBothEnd) {
  const AutoExposureParams params;
  const auto settled = [&](double light) {
    AutoExposure loop(params, 25.0, 1.0);
    for (int i = 0; i < 200; ++i) loop.see(greyOf(light, loop.setting()));
    return loop.setting();
  };
  EXPECT_EQ(settled(40.0).gain, 1.0);
  EXPECT_NEAR(settled(40.0).exposure_ms, 110.0 / 40.0, 0.8);
  EXPECT_EQ(settled(1.0).exposure_ms, 25.0);
  EXPECT_NEAR(settled(1.0).gain, 110.0 / 25.0, 1.2);
  EXPECT_NEAR(settled(0.0).gain, params.max_gain, 0.5);  // a step of 1/16 stop
  EXPECT_EQ(settled(0.0).exposure_ms, 25.0);
  EXPECT_NEAR(settled(1e6).exposure_ms, params.min_exposure_ms, 0.005);
}

TEST(ExposurePlan, GoesFromImageToImageAndIsTheSameEachTime) {
  SensorParams sensor;
  sensor.exposure_ms = 25.0;
  sensor.auto_exposure.on = true;
  // The light rises by two stops in image 10.
  const ExposureMeter meter = [](std::size_t image, const ExposureSetting& setting) {
    return greyOf(image < 10 ? 4.0 : 16.0, setting);
  };
  const auto plan = planExposures(sensor, 50, meter), again = planExposures(sensor, 50, meter);
  ASSERT_EQ(plan.size(), 50u);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(plan[i].exposure_ms, again[i].exposure_ms);
    EXPECT_EQ(plan[i].gain, again[i].gain);
  }
  for (std::size_t i = 1; i < 13; ++i) {
    EXPECT_EQ(plan[i].exposure_ms * plan[i].gain, plan[0].exposure_ms * plan[0].gain) << i;
  }
  EXPECT_NEAR(std::log2(plan[0].exposure_ms * plan[0].gain / (plan[49].exposure_ms * plan[49].gain)), 2.0,
              0.6);
  sensor.auto_exposure.on = false;
  EXPECT_EQ(planExposures(sensor, 3, nullptr).at(2).exposure_ms, 25.0);
}

TEST(ExposurePlan, ExposureMakesLightOnlyWhereFullScaleIsSet) {
  SensorParams sensor;
  EXPECT_EQ(signalPerLight(sensor, 7.0), 1.0);
  sensor.full_scale_ms = 70.0;
  EXPECT_DOUBLE_EQ(signalPerLight(sensor, 7.0), 0.1);
}

}  // namespace
}  // namespace stereo_nav::sim
