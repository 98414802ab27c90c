#include "navigation/control/pid.h"

#include <gtest/gtest.h>

#include "navigation/control/as_published.h"
#include "navigation/control/speed_loop.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::control {
namespace {

PidParams plain() {
  PidParams params;
  params.feed_forward = 0.0;
  params.proportional = 2.0;
  params.integral_per_s = 0.0;
  params.min_output = -1e3;
  params.max_output = 1e3;
  return params;
}

TEST(Pid, EachTermHasItsKnownAnswer) {
  PidParams params = plain();
  EXPECT_DOUBLE_EQ(Pid(params).update(3.0, 1.0, 0.1), 4.0);
  params.feed_forward = 0.5;
  EXPECT_DOUBLE_EQ(Pid(params).update(3.0, 1.0, 0.1), 5.5);
  params.integral_per_s = 10.0;
  Pid pid(params);
  pid.update(3.0, 1.0, 0.1);
  EXPECT_DOUBLE_EQ(pid.update(3.0, 1.0, 0.1), 7.5);  // 10 * 2 * 0.1 more
}

TEST(Pid, TheDerivativeIsThatOfTheMeasurement) {
  PidParams params = plain();
  params.proportional = 0.0;
  params.derivative_s = 1.0;
  params.derivative_filter_s = 0.0;
  Pid pid(params);
  EXPECT_DOUBLE_EQ(pid.update(0.0, 1.0, 0.1), 0.0);
  EXPECT_DOUBLE_EQ(pid.update(100.0, 1.0, 0.1), 0.0);  // a step of the wanted value gives no kick
  EXPECT_DOUBLE_EQ(pid.update(100.0, 1.5, 0.1), -5.0);
}

TEST(Pid, AtALimitTheIntegralDoesNotGrow) {
  PidParams params = plain();
  params.max_output = 3.0;
  params.proportional = 1.0;
  params.integral_per_s = 1.0;
  params.back_calculation_s = 0.0;
  Pid pid(params);
  for (int i = 0; i < 1000; ++i) pid.update(10.0, 0.0, 0.1);
  // What is needed for the limit and no more: the output leaves it with the error.
  EXPECT_LT(pid.update(0.0, 1.0, 0.1), 0.0);
}

TEST(Pid, LimitsThatLeaveNothingAreRefused) {
  PidParams params;
  params.min_output = params.max_output = 1.0;
  EXPECT_THROW(Pid{params}, ParameterError);
}

// Bounds of the loop of speed: overshoot 2 %, settled within 0.6 s, and within 0.6 s of the end of a block.
SpeedLoopRun ourLoop(double drive_gain) {
  PidParams params;
  params.min_output = 0.0;
  params.max_output = 1200.0;
  Pid pid(params);
  return runSpeedLoop([&](double wanted, double measured, double period_s) {
    return drive_gain * pid.update(wanted, measured, period_s);
  });
}

TEST(SpeedLoop, SettlesWithoutOvershootAlsoAfterABlockAndReachesZero) {
  const SpeedLoopRun run = ourLoop(1.0);
  EXPECT_LE(run.overshoot_mm_per_s, 18.0);
  EXPECT_LE(run.settled_s, 0.6);
  EXPECT_LE(run.settled_after_block_s, 0.6);
  EXPECT_LT(run.last_speed_mm_per_s, 1.0);
}

TEST(SpeedLoop, HoldsItsBoundsOnADriveThatIsATenthWeakerOrStronger) {
  for (const double gain : {0.9, 1.1}) {
    const SpeedLoopRun run = ourLoop(gain);
    EXPECT_LE(run.overshoot_mm_per_s, 18.0) << gain;
    EXPECT_LE(run.settled_s, 0.6) << gain;
    EXPECT_LE(run.settled_after_block_s, 0.6) << gain;
  }
}

TEST(SpeedLoop, ThePublishedLoopOvershootsAndNeverStops) {
  PublishedPid pid({});
  const SpeedLoopRun run = runSpeedLoop([&](double wanted, double measured, double period_s) {
    return pid.update(wanted, measured, period_s);
  });
  EXPECT_GT(run.overshoot_mm_per_s, 40.0);
  EXPECT_GT(run.settled_s, 0.6);
  EXPECT_NEAR(run.last_speed_mm_per_s, 100.0, 1.0);
}

}  // namespace
}  // namespace stereo_nav::control
