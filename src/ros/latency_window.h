#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <vector>

namespace stereo_nav::ros_io {

/// The last latencies in milliseconds and their quantiles.
class LatencyWindow {
 public:
  void add(double latency_ms) {
    window_.push_back(latency_ms);
    if (window_.size() > kSize) window_.pop_front();
  }

  std::size_t size() const { return window_.size(); }

  /// Nearest rank; 0 when empty. `share` 0.5 is the median.
  double quantile(double share) const {
    if (window_.empty()) return 0.0;
    std::vector<double> sorted(window_.begin(), window_.end());
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
  }

 private:
  static constexpr std::size_t kSize = 2000;
  std::deque<double> window_;
};

}  // namespace stereo_nav::ros_io
