#pragma once

#include <cstdint>
#include <string>

namespace stereo_nav::serial {

/// The state of the line to the module.
enum class LinkState {
  kDisconnected,  ///< the port cannot be opened, or has disappeared
  kWaiting,       ///< opened, but too early to tell
  kSilent,        ///< no bytes
  kNoFrames,      ///< bytes, but no frame
  kStreaming
};

/// Spread of the arrivals and of the stamps made from them.
class JitterMeter {
 public:
  /// `device_clock`: the module's own time or frame number. When it steps back, the meter starts again.
  void add(double arrival_s, double stamp_s, double device_clock);
  void restart() { *this = JitterMeter(); }

  double duration_s() const { return last_stamp_s_ - first_stamp_s_; }
  double rate_hz() const;
  /// Standard deviation of arrival minus stamp: what the stamp filter removed.
  double arrivalJitter_s() const;
  /// Standard deviation of the stamps' intervals from those of the device clock.
  double stampJitter_s() const;

 private:
  std::uint64_t count_ = 0;
  double first_stamp_s_ = 0.0, last_stamp_s_ = 0.0;
  double first_clock_ = 0.0, last_clock_ = 0.0;
  double delay_mean_ = 0.0, delay_m2_ = 0.0;
  double deviation_mean_ = 0.0, deviation_m2_ = 0.0;
};

/// Determines the state of a serial link from the bytes and frames of the last seconds.
class LinkMonitor {
 public:
  /// A stream is called silent or frameless after this time.
  static constexpr double kPatience_s = 1.0;

  /// Opening a port again that was not closed changes nothing: a silent port stays silent.
  void opened(double now_s);
  bool open() const { return open_; }
  void closed() { open_ = false; }
  void received(std::uint64_t bytes, double now_s);
  void delivered(double now_s);
  LinkState state(double now_s) const;
  double silentFor_s(double now_s) const;

 private:
  bool open_ = false;
  double opened_s_ = 0.0;
  double last_bytes_s_ = 0.0;
  double last_frame_s_ = 0.0;
  bool any_frame_ = false;
};

}  // namespace stereo_nav::serial
