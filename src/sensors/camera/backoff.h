#pragma once

#include <algorithm>
#include <chrono>

namespace stereo_nav::camera {

/// Waiting times between attempts: soon at first, then longer, never above a bound that keeps a camera's
/// return quick (it must be back in pairs within 3 s).
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
