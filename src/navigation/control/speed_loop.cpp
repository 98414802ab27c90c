#include "navigation/control/speed_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stereo_nav::control {
namespace {

constexpr double kPeriod_s = 0.02, kLag_s = 0.15;
constexpr double kMostCommand = 1200.0, kWanted = 900.0, kTolerance = 0.02 * kWanted;
constexpr double kBlock_s = 2.0, kBlockEnd_s = 2.6, kStop_s = 5.0, kEnd_s = 7.0;

/// How long after `from_s` the speed is near the wanted one for good, judged up to `to_s`.
double settled(const std::vector<SpeedLoopRun::Sample>& samples, double from_s, double to_s) {
  double last_off_s = from_s;
  for (const auto& sample : samples) {
    if (sample.time_s > from_s && sample.time_s <= to_s && std::abs(sample.speed - kWanted) > kTolerance)
      last_off_s = sample.time_s;
  }
  const bool at_end = last_off_s > to_s - 2.0 * kPeriod_s;
  return at_end ? std::numeric_limits<double>::infinity() : last_off_s + kPeriod_s - from_s;
}

}  // namespace

SpeedLoopRun runSpeedLoop(const SpeedController& controller) {
  SpeedLoopRun run;
  double speed = 0.0;
  for (int period = 1; period * kPeriod_s <= kEnd_s; ++period) {
    const double time_s = period * kPeriod_s;
    const double wanted = time_s > kStop_s ? 0.0 : kWanted;
    const double command = std::clamp(controller(wanted, speed, kPeriod_s), -kMostCommand, kMostCommand);
    const bool held = time_s > kBlock_s && time_s <= kBlockEnd_s;
    speed = held ? 0.0 : command + (speed - command) * std::exp(-kPeriod_s / kLag_s);
    run.samples.push_back({time_s, wanted, command, speed});
    run.overshoot_mm_per_s = std::max(run.overshoot_mm_per_s, speed - kWanted);
  }
  run.settled_s = settled(run.samples, 0.0, kBlock_s);
  run.settled_after_block_s = settled(run.samples, kBlockEnd_s, kStop_s);
  run.last_speed_mm_per_s = speed;
  return run;
}

}  // namespace stereo_nav::control
