#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace stereo_nav::vision {

/// 256 comparisons of grey levels around a corner: ORB (Rublee et al. 2011).
using Descriptor = std::array<std::uint64_t, 4>;

constexpr int kDescriptorBits = 256;

/// Bit `index` of 0 to 255.
inline bool bitOf(const Descriptor& descriptor, int index) {
  return ((descriptor[static_cast<std::size_t>(index / 64)] >> (index % 64)) & 1U) != 0;
}

/// Number of bits that differ, 0 to 256. Counted in parallel (Knuth, vol. 4A, 7.1.3): the instruction that
/// counts bits is not in every processor that the package is built for.
inline int hammingDistance(const Descriptor& a, const Descriptor& b) {
  std::uint64_t in_bytes = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::uint64_t bits = a[i] ^ b[i];
    bits -= (bits >> 1) & 0x5555555555555555U;
    bits = (bits & 0x3333333333333333U) + ((bits >> 2) & 0x3333333333333333U);
    in_bytes += (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fU;
  }
  const std::uint64_t in_pairs = (in_bytes & 0x00ff00ff00ff00ffU) + ((in_bytes >> 8) & 0x00ff00ff00ff00ffU);
  return static_cast<int>((in_pairs * 0x0001000100010001U) >> 48);
}

}  // namespace stereo_nav::vision
