#pragma once

#include <cstdint>
#include <optional>

namespace stereo_nav::base {

/// Notices that its program stood still: stopped by a signal, suspended with the computer, or not scheduled.
/// Orders that waited in its sockets meanwhile look as new as those that are sent now, so that none is to be
/// believed until the sockets are empty. Times are seconds of any clock that runs on.
class PauseGuard {
 public:
  /// To be called far more often than every kPause_s. Returns for how long the program stood still; 0 where
  /// it did not.
  double tick(double now_s) {
    const double gap_s = last_s_ ? now_s - *last_s_ : 0.0;
    last_s_ = now_s;
    if (gap_s <= kPause_s) return 0.0;
    blocked_until_s_ = now_s + kDrain_s;
    ++pauses_;
    return gap_s;
  }

  /// Whether orders are not to be believed; also before the first tick() after a pause, which another thread
  /// may be about to make.
  bool blocks(double now_s) const {
    return last_s_ && (now_s - *last_s_ > kPause_s || now_s < blocked_until_s_);
  }

  std::uint64_t pauses() const { return pauses_; }

 private:
  static constexpr double kPause_s = 0.1;
  static constexpr double kDrain_s = 0.1;  ///< in which the sockets are emptied

  std::optional<double> last_s_;
  double blocked_until_s_ = 0.0;
  std::uint64_t pauses_ = 0;
};

}  // namespace stereo_nav::base
