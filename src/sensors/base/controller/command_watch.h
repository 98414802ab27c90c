#pragma once

// Compiled by the controller, and by the host for its tests and the emulator: C++11, no library.

#include "protocol.h"

namespace stereo_nav {
namespace base {

/// Decides whether the wheels may turn: each command is valid for the time that it names, counted from its
/// arrival and never longer than kMaxValid_ms, and a stop holds until it is released.
class CommandWatch {
 public:
  void accept(const Command& command, uint32_t now_ms) {
    if ((command.flags & kStop) != 0) {
      stopped_ = true;
    } else if ((command.flags & kRelease) != 0) {
      stopped_ = false;
    }
    valid_ms_ = command.valid_ms < kMaxValid_ms ? command.valid_ms : kMaxValid_ms;
    accepted_ms_ = now_ms;
    any_ = true;
    link_is_up_ = true;
    is_valid_ = valid_ms_ > 0;
  }

  /// To be called in each period, and at least every 24 days, before mode() and linkIsUp().
  void step(uint32_t now_ms) {
    const uint32_t age_ms = now_ms - accepted_ms_;
    if (age_ms >= valid_ms_) is_valid_ = false;
    if (age_ms >= kMaxValid_ms) link_is_up_ = false;
  }

  Mode mode() const {
    if (stopped_) return Mode::kStopped;
    if (!any_) return Mode::kWaiting;
    return is_valid_ ? Mode::kDriving : Mode::kTimedOut;
  }
  /// Whether the host sends at all; actuators, which have no time of their own, rest while it does not.
  bool linkIsUp() const { return link_is_up_; }

 private:
  uint32_t accepted_ms_ = 0;
  uint16_t valid_ms_ = 0;
  bool any_ = false;
  bool link_is_up_ = false;
  bool is_valid_ = false;
  bool stopped_ = false;
};

}  // namespace base
}  // namespace stereo_nav
