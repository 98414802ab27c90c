#include "sensors/camera/clock_beat.h"

#include <cmath>
#include <limits>

namespace stereo_nav::camera {
namespace {

constexpr std::size_t kMostSamples = 300;
constexpr std::size_t kFewestSamples = 30;

}  // namespace

void ClockBeat::add(std::int64_t time_ns, std::int64_t time_offset_ns, std::int64_t period_ns) {
  if (!samples_.empty() && period_ns > 0) {
    const double jump =
        static_cast<double>(time_offset_ns - latest_time_offset_ns_) / static_cast<double>(period_ns);
    wrapped_ns_ -= std::llround(jump) * period_ns;
  }
  latest_time_offset_ns_ = time_offset_ns;
  samples_.emplace_back(1e-9 * static_cast<double>(time_ns),
                        1e-9 * static_cast<double>(time_offset_ns + wrapped_ns_));
  if (samples_.size() > kMostSamples) samples_.pop_front();
}

double ClockBeat::timeOffsetRate() const {
  if (samples_.size() < kFewestSamples) return std::numeric_limits<double>::quiet_NaN();
  double mean_time = 0.0;
  double mean_offset = 0.0;
  for (const auto& [time, offset] : samples_) {
    mean_time += time - samples_.front().first;
    mean_offset += offset;
  }
  const auto count = static_cast<double>(samples_.size());
  mean_time = samples_.front().first + mean_time / count;
  mean_offset /= count;
  double covariance = 0.0;
  double variance = 0.0;
  for (const auto& [time, offset] : samples_) {
    covariance += (time - mean_time) * (offset - mean_offset);
    variance += (time - mean_time) * (time - mean_time);
  }
  return variance > 0.0 ? covariance / variance : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace stereo_nav::camera
