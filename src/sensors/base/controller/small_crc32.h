#pragma once

// Compiled by the controller, and by the host for its tests and the emulator: C++11, no library.

#include <stddef.h>
#include <stdint.h>

namespace stereo_nav {
namespace base {

/// CRC-32 of IEEE 802.3 by half bytes: 64 bytes of table, for a controller without a library that has it.
struct SmallCrc32 {
  static uint32_t of(const uint8_t* bytes, size_t size) {
    static const uint32_t kTable[16] = {
        0x00000000, 0x1DB71064, 0x3B6E20C8, 0x26D930AC, 0x76DC4190, 0x6B6B51F4, 0x4DB26158, 0x5005713C,
        0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C, 0x9B64C2B0, 0x86D3D2D4, 0xA00AE278, 0xBDBDF21C};
    uint32_t crc = 0xFFFFFFFFU;
    for (size_t i = 0; i < size; ++i) {
      crc ^= bytes[i];
      crc = (crc >> 4) ^ kTable[crc & 0x0FU];
      crc = (crc >> 4) ^ kTable[crc & 0x0FU];
    }
    return ~crc;
  }
};

}  // namespace base
}  // namespace stereo_nav
