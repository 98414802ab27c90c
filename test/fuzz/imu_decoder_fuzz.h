#pragma once

#include <cstddef>
#include <cstdint>

#include "sensors/imu/frame_decoder.h"

namespace stereo_nav::imu {

/// Decodes arbitrary bytes and aborts when the result breaks a promise: used by the fuzzer, and on its corpus
/// by a unit test.
void decodeFuzzInput(Protocol protocol, const std::uint8_t* data, std::size_t size);

}  // namespace stereo_nav::imu
