#pragma once

#include <cstdint>
#include <cstring>

namespace stereo_nav::serial {

template <class Unsigned>
Unsigned readUnsigned(const std::uint8_t* bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) value |= std::uint64_t{bytes[i]} << (8 * i);
  return static_cast<Unsigned>(value);
}

template <class Unsigned>
void writeUnsigned(Unsigned value, std::uint8_t* bytes) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    bytes[i] = static_cast<std::uint8_t>(std::uint64_t{value} >> (8 * i));
  }
}

inline float readFloat(const std::uint8_t* bytes) {
  const auto bits = readUnsigned<std::uint32_t>(bytes);
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

inline void writeFloat(float value, std::uint8_t* bytes) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  writeUnsigned(bits, bytes);
}

}  // namespace stereo_nav::serial
