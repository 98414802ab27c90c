#include "sensors/base/telemetry_decoder.h"

namespace stereo_nav::base {
namespace {

/// Bits on the wire for a byte: start bit, eight data bits, stop bit.
constexpr double kBitsPerByte = 10.0;
/// After a silence as long as this the controller may have been restarted: it counts anew.
constexpr double kSilence_s = 0.3;

}  // namespace

TelemetryDecoder::TelemetryDecoder(int baud_rate) : byte_time_s_(kBitsPerByte / baud_rate) {}

void TelemetryDecoder::push(const std::uint8_t* data, std::size_t size, double read_time_s,
                            const Sink& sink) {
  if (size > 0 && read_time_s - last_frame_s_ > kSilence_s) parser_.forgetSequence();
  DecodedTelemetry decoded;
  for (std::size_t i = 0; i < size; ++i) {
    if (!parser_.push(data[i], decoded.telemetry)) continue;
    const auto behind = static_cast<double>(parser_.pending() + (size - 1 - i));
    const auto frame_bytes = static_cast<double>(kPrefixBytes + payloadBytes(decoded.telemetry) + kCrcBytes);
    decoded.arrival_s = read_time_s - behind * byte_time_s_;
    decoded.wire_s = frame_bytes * byte_time_s_;
    decoded.device_clock_s = unwrap(decoded.telemetry.time_us);
    last_frame_s_ = read_time_s;
    sink(decoded);
  }
}

void TelemetryDecoder::reset() {
  parser_.reset();
  last_time_us_.reset();
}

/// A step back, as after a restart of the controller, remains a step back.
double TelemetryDecoder::unwrap(std::uint32_t time_us) {
  if (last_time_us_) time_s_ += static_cast<std::int32_t>(time_us - *last_time_us_) * 1e-6;
  last_time_us_ = time_us;
  return time_s_;
}

}  // namespace stereo_nav::base
