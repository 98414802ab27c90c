#include "fuzz/imu_decoder_fuzz.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace stereo_nav::imu {
namespace {

constexpr int kFuzzBaud = 115200;

/// What must hold of everything that is delivered, whatever the bytes were.
void checkFrame(const DecodedFrame& frame) {
  const auto require = [](bool condition) {
    if (!condition) std::abort();
  };
  require(frame.angles.has_value() != frame.raw.has_value());
  require(std::isfinite(frame.device_clock) && std::isfinite(frame.arrival_s));
  if (frame.angles)
    require(frame.angles->vector().allFinite() && frame.angles->vector().cwiseAbs().maxCoeff() < 361);
  if (frame.raw)
    require(frame.raw->angular_velocity.allFinite() && frame.raw->linear_acceleration.allFinite());
}

}  // namespace

void decodeFuzzInput(Protocol protocol, const std::uint8_t* data, std::size_t size) {
  if (size == 0) return;
  const auto decoder = protocol == Protocol::kAngles
                           ? makeAngleDecoder(AngleOrder::kYawPitchRoll, AngleGateParams(), kFuzzBaud)
                           : makeRawDecoder(kFuzzBaud);
  // The first byte says how the rest is cut into reads, and how much time passes between them.
  const std::size_t piece = 1 + data[0] % 40;
  const double pause_s = data[0] / 40 * 0.004;
  double now_s = 0.0;
  for (std::size_t i = 1; i < size; i += piece) {
    decoder->push(data + i, std::min(piece, size - i), now_s, checkFrame);
    now_s += pause_s;
  }
  const DecoderCounters counters = decoder->counters();
  if (counters.bytes != size - 1 || counters.bytes_skipped > counters.bytes * 20) std::abort();
}

}  // namespace stereo_nav::imu
