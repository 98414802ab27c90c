#pragma once

#include <boost/crc.hpp>
#include <cstddef>
#include <cstdint>

namespace stereo_nav::base {

/// The protocol's check sum on the host: CRC-32 of IEEE 802.3, as zlib's. The controller has its own, which
/// is small: controller/small_crc32.h.
struct Crc32 {
  static std::uint32_t of(const std::uint8_t* bytes, std::size_t size) {
    boost::crc_32_type crc;
    crc.process_bytes(bytes, size);
    return crc.checksum();
  }
};

}  // namespace stereo_nav::base
