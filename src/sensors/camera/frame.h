#pragma once

#include <cstdint>
#include <limits>

#include "sensors/camera/decoder.h"

namespace stereo_nav::camera {

enum class Side { kLeft, kRight };

/// "left" or "right", for messages and topics.
inline const char* sideName(Side side) {
  return side == Side::kLeft ? "left" : "right";
}
inline Side otherSide(Side side) {
  return side == Side::kLeft ? Side::kRight : Side::kLeft;
}

/// One image with its times, all in nanoseconds of CLOCK_MONOTONIC.
struct Frame {
  DecodedImage image;
  std::int64_t time_ns = 0;      ///< middle of the exposure and of the rows, as far as known
  std::int64_t stamp_ns = 0;     ///< the driver's stamp, in the monotonic clock
  std::int64_t dequeued_ns = 0;  ///< when the frame was taken from the driver
  std::int64_t decoding_ns = 0;  ///< how long decoding took
  std::uint32_t sequence = 0;    ///< the driver's counter
  std::uint64_t lost = 0;        ///< frames that this camera's driver has lost so far
  double exposure_s = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace stereo_nav::camera
