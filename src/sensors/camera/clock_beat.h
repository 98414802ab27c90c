#pragma once

#include <cstdint>
#include <deque>
#include <utility>

namespace stereo_nav::camera {

/// How fast two free-running cameras slide past each other: the slope of the skew over time, by least squares
/// over the latest pairs. When the pairing moves on by one frame the skew jumps by a period; the jump is
/// taken out, the slide goes on.
class ClockBeat {
 public:
  /// `period_ns`: the time between frames, by which the skew jumps.
  void add(std::int64_t time_ns, std::int64_t skew_ns, std::int64_t period_ns);

  /// Seconds of skew gained per second; NaN until there are enough pairs.
  double skewRate() const;

 private:
  std::deque<std::pair<double, double>> samples_;  ///< seconds, seconds of unwrapped skew
  std::int64_t wrapped_ns_ = 0;
  std::int64_t latest_skew_ns_ = 0;
};

}  // namespace stereo_nav::camera
