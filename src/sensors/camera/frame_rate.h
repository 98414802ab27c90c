#pragma once

#include <cstdint>
#include <deque>

namespace stereo_nav::camera {

/// Rate of events over the last second or so.
class FrameRate {
 public:
  void add(std::int64_t time_ns) {
    times_.push_back(time_ns);
    while (times_.size() > 2 && times_.back() - times_.front() > kWindow_ns) times_.pop_front();
  }

  void restart() { times_.clear(); }

  /// 0 until two events were seen, and when the last one lies more than the window before `now_ns`.
  double rate_hz(std::int64_t now_ns) const {
    if (times_.size() < 2 || now_ns - times_.back() > kWindow_ns) return 0.0;
    const auto duration_ns = times_.back() - times_.front();
    return duration_ns > 0 ? 1e9 * static_cast<double>(times_.size() - 1) / static_cast<double>(duration_ns)
                           : 0.0;
  }

 private:
  static constexpr std::int64_t kWindow_ns = 1'500'000'000;
  std::deque<std::int64_t> times_;
};

}  // namespace stereo_nav::camera
