#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "sensors/imu/angle_gate.h"
#include "stereo_nav/sensors/imu/raw_protocol.h"

namespace stereo_nav::imu {

enum class Protocol { kAngles, kRaw };

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
  std::uint64_t lost_frames = 0;  ///< gaps: by sequence number (raw), by bytes (angles)
};

/// Bytes in, frames out, for one of the two protocols.
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

}  // namespace stereo_nav::imu
