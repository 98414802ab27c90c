#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace stereo_nav::serial {
namespace internal {

constexpr std::array<std::uint32_t, 256> makeCrcTable() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    table[byte] = crc;
  }
  return table;
}

inline constexpr auto kCrcTable = makeCrcTable();

}  // namespace internal

/// CRC-32 of IEEE 802.3: reflected polynomial 0xEDB88320, start and final inversion 0xFFFFFFFF. The check
/// value of "123456789" is 0xCBF43926.
inline std::uint32_t crc32(const std::uint8_t* data, std::size_t size) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::size_t i = 0; i < size; ++i) crc = (crc >> 8) ^ internal::kCrcTable[(crc ^ data[i]) & 0xFFU];
  return ~crc;
}

}  // namespace stereo_nav::serial
