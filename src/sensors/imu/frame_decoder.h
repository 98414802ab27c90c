#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "sensors/imu/angle_gate.h"
#include "stereo_nav/sensors/imu/raw_protocol.h"

namespace stereo_nav::imu {

/// What a module sends; a phone's text comes over UDP alone, angles over serial lines alone.
enum class Protocol { kAngles, kRaw, kPhone };

/// One frame of either protocol; exactly one of `angles` and `raw` is present.
struct DecodedFrame {
  std::optional<ModuleAngles> angles;
  std::optional<RawMeasurement> raw;
  double device_clock = 0.0;       ///< grows: frame number (angles) or the module's time in seconds (raw)
  double device_clock_step = 1.0;  ///< step of that clock that hides a frame lost unnoticed
  double arrival_s = 0.0;          ///< arrival of the last byte, on the clock of the read times
  bool clock_restarted = false;    ///< the device clock stood still for an unknown time before this frame
};

/// Since the decoder was made.
struct DecoderCounters {
  std::uint64_t bytes = 0;
  std::uint64_t bytes_skipped = 0;
  std::uint64_t frames = 0;
  std::uint64_t bad_frames = 0;   ///< check sum wrong, values impossible or implausible
  std::uint64_t lost_frames = 0;  ///< gaps: by sequence number (raw), bytes (angles) or time (phone)
  std::uint64_t late_frames = 0;  ///< over UDP: overtaken by a newer one, or doubled; left out
};

/// Bytes in, frames out, for one of the protocols.
class FrameDecoder {
 public:
  using Sink = std::function<void(const DecodedFrame&)>;

  virtual ~FrameDecoder() = default;
  /// `read_time_s`: when the bytes were read. Byte i of `size` must have arrived earlier by the time that the
  /// `size - 1 - i` bytes behind it need on the wire; that time is subtracted.
  virtual void push(const std::uint8_t* data, std::size_t size, double read_time_s, const Sink& sink) = 0;
  /// Begins a new stream; the counters keep their values.
  virtual void reset() = 0;
  virtual DecoderCounters counters() const = 0;
  /// Time on the wire from the first to the last byte of a frame, with start and stop bits.
  virtual double wireTime_s() const = 0;
};

/// `baud_rate` is that of the line, bits/s: it tells how long a frame is on the wire.
std::unique_ptr<FrameDecoder> makeAngleDecoder(AngleOrder order, const AngleGateParams& gate, int baud_rate);
std::unique_ptr<FrameDecoder> makeRawDecoder(int baud_rate);
/// Over UDP each push() is one datagram, and each datagram stands for itself: those that were overtaken are
/// left out. A raw datagram holds whole frames, a phone's one sample (phone_protocol.h).
std::unique_ptr<FrameDecoder> makeRawDatagramDecoder();
std::unique_ptr<FrameDecoder> makePhoneDecoder();

}  // namespace stereo_nav::imu
