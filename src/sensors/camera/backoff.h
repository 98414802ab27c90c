#pragma once

#include <algorithm>
#include <chrono>

namespace stereo_nav::camera {

/// Waiting times between attempts: short at first, then longer. They stay below a bound, so that a camera
/// that returns delivers pairs again within 3 s.
class Backoff {
 public:
  using Duration = std::chrono::milliseconds;

  void reset() { next_ = kFirst; }
  Duration next() {
    const Duration wait = next_;
    next_ = std::min(next_ * 2, kLongest);
    return wait;
  }

 private:
  static constexpr Duration kFirst{100};
  static constexpr Duration kLongest{800};
  Duration next_ = kFirst;
};

}  // namespace stereo_nav::camera
