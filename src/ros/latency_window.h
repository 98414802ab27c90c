#pragma once

#include <cstddef>
#include <deque>

#include "core/statistics.h"

namespace stereo_nav::ros_io {

/// The last latencies in milliseconds and their quantiles.
class LatencyWindow {
 public:
  void add(double latency_ms) {
    window_.push_back(latency_ms);
    if (window_.size() > kSize) window_.pop_front();
  }

  std::size_t size() const { return window_.size(); }

  /// 0 when empty. `share` 0.5 is the median.
  double quantile(double share) const {
    if (window_.empty()) return 0.0;
    return stereo_nav::quantile({window_.begin(), window_.end()}, share);
  }

 private:
  static constexpr std::size_t kSize = 2000;
  std::deque<double> window_;
};

}  // namespace stereo_nav::ros_io
