#pragma once

#include <cstddef>
#include <cstdint>

#include "sensors/serial/crc32.h"

namespace stereo_nav::base {

/// The protocol's check sum on the host: CRC-32 of IEEE 802.3, as zlib's. The controller has its own, which
/// is small: controller/small_crc32.h.
struct Crc32 {
  static std::uint32_t of(const std::uint8_t* bytes, std::size_t size) { return serial::crc32(bytes, size); }
};

}  // namespace stereo_nav::base
