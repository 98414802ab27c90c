#pragma once

#include <boost/crc.hpp>
#include <cstddef>
#include <cstdint>

namespace stereo_nav::serial {

/// CRC-32 of IEEE 802.3, as zlib's: reflected polynomial 0xEDB88320, start and final inversion 0xFFFFFFFF.
/// The check value of "123456789" is 0xCBF43926.
inline std::uint32_t crc32(const std::uint8_t* data, std::size_t size) {
  boost::crc_32_type crc;
  crc.process_bytes(data, size);
  return crc.checksum();
}

}  // namespace stereo_nav::serial
