#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "sensors/base/controller/frame_parser.h"
#include "sensors/base/crc32.h"

namespace stereo_nav::base {

/// One frame with what is needed to stamp it.
struct DecodedTelemetry {
  Telemetry telemetry{};
  double device_clock_s = 0.0;  ///< the controller's time without its wrap
  double arrival_s = 0.0;       ///< of the last byte, on the clock of the read times
  double wire_s = 0.0;          ///< time of the frame on the wire
};

/// Bytes in, telemetry out.
class TelemetryDecoder {
 public:
  using Sink = std::function<void(const DecodedTelemetry&)>;

  explicit TelemetryDecoder(int baud_rate);

  /// `read_time_s`: when the bytes were read. A byte must have arrived earlier by the time that the bytes
  /// behind it need on the wire; that time is subtracted.
  void push(const std::uint8_t* data, std::size_t size, double read_time_s, const Sink& sink);
  /// Begins a new stream; the counters keep their values.
  void reset();
  const ParserCounters& counters() const { return parser_.counters(); }

 private:
  double unwrap(std::uint32_t time_us);

  FrameParser<Telemetry, Crc32> parser_;
  double byte_time_s_;
  std::optional<std::uint32_t> last_time_us_;
  double time_s_ = 0.0;
  double last_frame_s_ = 0.0;
};

}  // namespace stereo_nav::base
