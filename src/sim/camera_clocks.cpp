#include "sim/camera_clocks.h"

#include <algorithm>
#include <cmath>

#include "sim/random.h"

namespace stereo_nav::sim {
namespace {

enum Draw { kLeftJitter, kRightJitter, kPhase };

/// Jitter is bounded to 3 sigma and to less than half a period, so that images keep their order.
double jitter(const TimingParams& timing, std::uint64_t seed, Draw camera, std::uint64_t index) {
  const double bounded = std::clamp(normalDraw(streamKey(seed, Stream::kClock, camera), index), -3.0, 3.0);
  const double limit_s = 0.45 / timing.rate_hz;
  return std::clamp(1e-3 * timing.jitter_ms * bounded, -limit_s, limit_s);
}

std::size_t nearestIndex(const std::vector<double>& times_s, double time_s) {
  const auto after = std::lower_bound(times_s.begin(), times_s.end(), time_s);
  if (after == times_s.begin()) return 0;
  const auto index = static_cast<std::size_t>(after - times_s.begin());
  if (after == times_s.end()) return index - 1;
  return *after - time_s < time_s - *(after - 1) ? index : index - 1;
}

}  // namespace

std::vector<PairInstants> pairInstants(const TimingParams& timing, double duration_s, std::uint64_t seed) {
  const double period_s = 1.0 / timing.rate_hz;
  const double right_period_s = timing.free_running ? period_s * (1.0 + 1e-6 * timing.clock_ppm) : period_s;
  const double phase =
      timing.free_running ? uniformDraw(streamKey(seed, Stream::kClock, kPhase), 0) - 0.5 : 0.0;
  const double right_start_s = 1e-3 * timing.time_offset_ms + phase * period_s;

  std::vector<double> left_s, right_s;
  const auto images = static_cast<std::uint64_t>(std::floor(duration_s * timing.rate_hz)) + 1;
  for (std::uint64_t i = 0; i < images; ++i) {
    left_s.push_back(static_cast<double>(i) * period_s + jitter(timing, seed, kLeftJitter, i));
    right_s.push_back(right_start_s + static_cast<double>(i) * right_period_s +
                      jitter(timing, seed, kRightJitter, i));
  }

  std::vector<PairInstants> pairs;
  std::uint64_t dropped = 0;
  for (std::size_t left = 0; left < left_s.size(); ++left) {
    const std::size_t right = nearestIndex(right_s, left_s[left]);
    const bool mutual = nearestIndex(left_s, right_s[right]) == left;
    if (mutual && std::fabs(right_s[right] - left_s[left]) <= 0.5 * period_s) {
      pairs.push_back({left_s[left], right_s[right], static_cast<std::uint32_t>(left),
                       static_cast<std::uint32_t>(right), dropped});
    } else {
      ++dropped;
    }
  }
  return pairs;
}

void TimingParams::describe(ParameterVisitor& visitor) {
  visitor.real("rate_hz", rate_hz, {0.1, 1000.0}, "Hz", "images per second of each camera");
  visitor.real("time_offset_ms", time_offset_ms, {-500.0, 500.0}, "ms",
               "the right image is taken this much after the left");
  visitor.real("jitter_ms", jitter_ms, {0.0, 100.0}, "ms", "standard deviation of each image's instant");
  visitor.flag("free_running", free_running,
               "the right camera starts at a random moment and its clock runs at its own rate");
  visitor.real("clock_ppm", clock_ppm, {-10000.0, 10000.0}, "ppm",
               "free running: the right camera's period is longer by this");
}

}  // namespace stereo_nav::sim
