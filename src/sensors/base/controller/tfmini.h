#pragma once

// Compiled by the controller, and by the host for its tests: C++11, no library.

#include "protocol.h"

namespace stereo_nav {
namespace base {

struct TfminiLimits {
  uint16_t min_mm, max_mm;
  uint16_t min_strength;  ///< less light that came back is none
};

/// A TFmini on a serial port of the controller: 0x59 0x59, distance in cm, strength, temperature, sum; 100
/// frames a second at 115200 baud. Judges as range_bridge does.
class Tfmini {
 public:
  explicit Tfmini(const TfminiLimits& limits) : limits_(limits) {}

  void receive(uint8_t byte, uint32_t now_ms) {
    if (size_ < 2 && byte != kHeader) {
      size_ = 0;
      return;
    }
    frame_[size_++] = byte;
    if (size_ < sizeof frame_) return;
    size_ = 0;
    uint8_t sum = 0;
    for (uint8_t i = 0; i + 1U < sizeof frame_; ++i) sum = static_cast<uint8_t>(sum + frame_[i]);
    if (sum != frame_[sizeof frame_ - 1]) return;
    range_mm_ = judged(number(2), number(4));
    heard_ms_ = now_ms;
    was_heard_ = true;
  }

  /// kRangeUnknown where it has been silent for longer than kSilence_ms. To be asked more often than the
  /// clock wraps.
  uint16_t range_mm(uint32_t now_ms) {
    if (now_ms - heard_ms_ > kSilence_ms) was_heard_ = false;
    return was_heard_ ? range_mm_ : kRangeUnknown;
  }

 private:
  static constexpr uint8_t kHeader = 0x59;
  static constexpr uint16_t kDazzled = 0xFFFF;      ///< strength
  static constexpr uint16_t kFirstFailure = 65532;  ///< distances from here on are codes
  static constexpr uint32_t kSilence_ms = 200;

  uint16_t number(uint8_t at) const { return static_cast<uint16_t>(frame_[at] | (frame_[at + 1] << 8)); }

  uint16_t judged(uint16_t distance_cm, uint16_t strength) const {
    if (strength == kDazzled) return kRangeUnknown;
    if (strength < limits_.min_strength) return kRangeNothing;
    if (distance_cm >= kFirstFailure) return kRangeUnknown;
    if (distance_cm > limits_.max_mm / 10) return kRangeNothing;
    const uint16_t mm = static_cast<uint16_t>(10 * distance_cm);
    return mm < limits_.min_mm ? kRangeTooNear : mm;
  }

  TfminiLimits limits_;
  uint8_t frame_[9] = {};
  uint8_t size_ = 0;
  uint16_t range_mm_ = kRangeUnknown;
  uint32_t heard_ms_ = 0;
  bool was_heard_ = false;
};

}  // namespace base
}  // namespace stereo_nav
