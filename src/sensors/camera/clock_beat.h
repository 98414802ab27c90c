#pragma once

#include <cstdint>
#include <deque>
#include <utility>

namespace stereo_nav::camera {

/// How fast the time offset between two free-running cameras changes: the slope of the offset (right minus
/// left) over time, by least squares over the latest pairs. When the pairing moves on by one frame the offset
/// jumps by a period; such jumps are removed.
class ClockBeat {
 public:
  /// `period_ns`: the time between frames, by which the offset jumps.
  void add(std::int64_t time_ns, std::int64_t time_offset_ns, std::int64_t period_ns);

  /// Change of the time offset in seconds per second; NaN until there are enough pairs.
  double timeOffsetRate() const;

 private:
  std::deque<std::pair<double, double>> samples_;  ///< time and unwrapped time offset, s
  std::int64_t wrapped_ns_ = 0;
  std::int64_t latest_time_offset_ns_ = 0;
};

}  // namespace stereo_nav::camera
