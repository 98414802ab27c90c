#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "sensors/serial/link.h"
#include "sensors/serial/stamp_filter.h"

namespace stereo_nav::serial {

/// How a device says what is seen of its line.
struct LinkWords {
  std::string waiting;                   ///< opened, but too early to tell
  std::string silence = "no bytes for";  ///< before the seconds
  std::string silent;                    ///< after them: likely cause and remedy
  std::string no_frames;                 ///< what arrives is no frame
  std::string streaming;                 ///< all is well
};
/// What is seen of the line; when something is wrong, also the likely cause and the remedy.
std::string explain(const LinkStatus& link, const LinkWords& words);

/// A snapshot for diagnostics. Jitters are standard deviations, see JitterMeter; rate and jitters are those
/// of the last full five seconds, and zero while nothing streams.
struct DeviceStatus {
  LinkState state = LinkState::kDisconnected;
  std::string message;  ///< explain()
  double rate_hz = 0.0;
  double arrival_jitter_s = 0.0;
  double stamp_jitter_s = 0.0;
  std::uint64_t connections = 0;
};

/// A link to a module whose frames have a clock or a number: gives each frame the time at which it was sent,
/// and measures rate and jitters.
class FrameLink {
 public:
  FrameLink(const LinkParams& params, const StampFilterParams& stamps, Link::Open open);

  /// As Link::read().
  std::size_t read(std::uint8_t* buffer, std::size_t capacity, double timeout_s) {
    return link_.read(buffer, capacity, timeout_s);
  }
  /// When a frame that arrived at `arrival_s` was sent, on the steady clock; see StampFilter::stamp(). Called
  /// in the thread of read(), for each frame once.
  double stamp(double device_clock, double step, double arrival_s);
  /// As StampFilter::restartClock().
  void restartClock() { stamps_.restartClock(); }
  /// As Link::disconnect().
  void disconnect(const SerialError& error) { link_.disconnect(error); }

  /// May be called from any thread.
  DeviceStatus status(const LinkWords& words) const;

 private:
  StampFilter stamps_;
  Link link_;

  mutable std::mutex mutex_;  ///< guards what follows
  JitterMeter jitter_;
  DeviceStatus report_;
};

}  // namespace stereo_nav::serial
