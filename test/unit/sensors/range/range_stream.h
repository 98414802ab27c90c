#pragma once

#include <cstdint>
#include <vector>

#include "sensors/range/tfmini_protocol.h"

namespace stereo_nav::range {

using Bytes = std::vector<std::uint8_t>;

/// Frame number k; strengths and temperatures pass through the value of the header.
inline TfminiMeasurement measurementOf(std::uint64_t k) {
  TfminiMeasurement measurement;
  measurement.distance_cm = static_cast<std::uint16_t>(10 + k * 37 % 1190);
  measurement.strength = static_cast<std::uint16_t>(0x5900 + k % 256);
  measurement.temperature = static_cast<std::uint16_t>(0x0900 + k % 256);
  return measurement;
}

inline Bytes bytesOf(std::uint64_t k) {
  Bytes bytes(tfmini::kFrameBytes);
  tfmini::encode(measurementOf(k), bytes.data());
  return bytes;
}

inline Bytes bytesOf(std::uint64_t first, std::uint64_t last) {
  Bytes bytes;
  for (std::uint64_t k = first; k < last; ++k) {
    const Bytes one = bytesOf(k);
    bytes.insert(bytes.end(), one.begin(), one.end());
  }
  return bytes;
}

inline bool same(const TfminiMeasurement& a, const TfminiMeasurement& b) {
  return a.distance_cm == b.distance_cm && a.strength == b.strength && a.temperature == b.temperature;
}

inline std::vector<TfminiFrame> parsed(TfminiParser& parser, const Bytes& bytes) {
  std::vector<TfminiFrame> frames;
  for (const std::uint8_t byte : bytes) {
    if (const auto frame = parser.push(byte)) frames.push_back(*frame);
  }
  return frames;
}

}  // namespace stereo_nav::range
