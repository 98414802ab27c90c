#include "sensors/serial/stamp_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sensors/serial/link_monitor.h"

namespace stereo_nav::serial {
namespace {

/// A module whose frames pass an adapter that hands over at multiples of its period, and a host that adds up
/// to a millisecond.
class BatchedModule {
 public:
  BatchedModule(double period_s, double batch_s) : period_s_(period_s), batch_s_(batch_s) {}
  double sent_s(int k) const { return 100.0 + period_s_ * k; }
  double arrival_s(int k) {
    std::exponential_distribution<double> host(1.0 / 1e-4);
    return std::ceil(sent_s(k) / batch_s_) * batch_s_ + std::min(host(random_), 1e-3);
  }

 private:
  double period_s_, batch_s_;
  std::mt19937 random_{4};
};

struct Errors {
  double stddev_s, max_step_s, max_late_s, mean_s;
};

/// Error of the stamps against the sending times after the filter has settled.
Errors errorsOf(StampFilter& filter, BatchedModule& module, int from, int to, double shift = 0.0) {
  double sum = 0.0, squares = 0.0, max_step = 0.0, max_late = -1.0, previous = 0.0;
  for (int k = from; k < to; ++k) {
    const double arrival = module.arrival_s(k);
    const double stamp = filter.stamp(k - shift, 1.0, arrival);
    const double error = stamp - module.sent_s(k);
    sum += error;
    squares += error * error;
    if (k > from) max_step = std::max(max_step, std::abs(error - previous));
    max_late = std::max(max_late, stamp - arrival);
    previous = error;
  }
  const double mean = sum / (to - from);
  return {std::sqrt(std::max(0.0, squares / (to - from) - mean * mean)), max_step, max_late, mean};
}

TEST(StampFilter, RemovesBatchesOf16MillisecondsAt100Hertz) {
  // Real oscillators are off by up to half a per cent, and never exactly commensurable with the batches.
  for (const double period_s : {0.01, 0.0100003, 0.00995, 0.01005, 0.0099}) {
    BatchedModule module(period_s, 0.016);
    StampFilter filter({});
    errorsOf(filter, module, 0, 300);
    const Errors errors = errorsOf(filter, module, 300, 12000);
    EXPECT_LT(errors.stddev_s, 1e-3) << "period " << period_s;
    EXPECT_LT(errors.max_step_s, 3e-3) << "period " << period_s;
    EXPECT_LE(errors.max_late_s, 1e-9) << "a stamp lies behind the arrival";
    EXPECT_LT(std::abs(errors.mean_s), 2.5e-3);
    EXPECT_NEAR(*filter.slope(), period_s, 1e-4 * period_s);
  }
}

TEST(StampFilter, StampsGrow) {
  BatchedModule module(0.00995, 0.016);
  StampFilter filter({});
  double last = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const double stamp = filter.stamp(k, 1.0, module.arrival_s(k));
    ASSERT_GT(stamp, last);
    last = stamp;
  }
}

TEST(StampFilter, FindsBackAfterFramesWereLostUnnoticed) {
  BatchedModule module(0.00995, 0.016);
  StampFilter filter({});
  errorsOf(filter, module, 0, 3000);
  errorsOf(filter, module, 3003, 3100, 3.0);
  const Errors errors = errorsOf(filter, module, 3100, 6000, 3.0);
  EXPECT_LT(errors.stddev_s, 1e-3);
  EXPECT_LT(std::abs(errors.mean_s), 2.5e-3);
}

TEST(StampFilter, BeginsAnewAfterASilence) {
  BatchedModule module(0.00995, 0.016);
  StampFilter filter({});
  errorsOf(filter, module, 0, 3000);
  // Nobody counted the frames of the five seconds in between.
  filter.restartClock();
  const Errors errors = errorsOf(filter, module, 3500, 5000, 500.0);
  EXPECT_LT(errors.stddev_s, 1e-3);
}

TEST(StampFilter, StandsAProgramThatSleepsWhileTheModuleGoesOn) {
  // Every 7 s nothing is read for 1.3 s; then everything comes at once, at the pace of the line.
  BatchedModule module(0.00995, 0.016);
  StampFilter filter({});
  double worst = 0.0, ready_s = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const double t = module.arrival_s(k);
    const double awake_s = std::fmod(t, 7.0) < 1.3 ? t - std::fmod(t, 7.0) + 1.3 : t;
    ready_s = std::max(awake_s, ready_s + 0.0013);
    const double stamp = filter.stamp(k, 1.0, ready_s);
    if (t > 102.0 + 10.0) worst = std::max(worst, std::abs(stamp - module.sent_s(k)));
  }
  EXPECT_LT(worst, 3e-3);
}

TEST(StampFilter, FollowsAClockThatStartsOver) {
  StampFilter filter({});
  for (int k = 0; k < 1000; ++k) filter.stamp(0.001 * k, 0.04, 50.0 + 0.001 * k);
  EXPECT_NEAR(filter.stamp(0.0, 0.04, 51.2), 51.2, 1e-6);
  EXPECT_NEAR(filter.stamp(0.001, 0.04, 51.201), 51.201, 1e-6);
}

TEST(StampFilter, FollowsAClockThatWarmsUp) {
  // 50 ppm over 100 s.
  StampFilter filter({});
  double worst = 0.0, sent = 10.0;
  for (int k = 0; k < 20000; ++k) {
    sent += 0.01 * (1.0 + 50e-6 * std::min(1.0, k / 10000.0));
    const double stamp = filter.stamp(k, 1.0, std::ceil(sent / 0.016) * 0.016);
    if (k > 500) worst = std::max(worst, std::abs(stamp - sent));
  }
  EXPECT_LT(worst, 3e-3);
}

TEST(JitterMeter, MeasuresRateAndSpread) {
  JitterMeter meter;
  for (int k = 0; k < 1000; ++k) meter.add(0.01 * k + (k % 2) * 0.002, 0.01 * k, k);
  EXPECT_NEAR(meter.rate_hz(), 100.0, 1e-6);
  EXPECT_NEAR(meter.arrivalJitter_s(), 1e-3, 1e-5);
  EXPECT_NEAR(meter.stampJitter_s(), 0.0, 1e-9);
}

}  // namespace
}  // namespace stereo_nav::serial
