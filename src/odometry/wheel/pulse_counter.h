#pragma once

#include <cstdint>

namespace stereo_nav::odometry {

/// Difference of two readings of a counter that wraps after `bits` bits, taken the short way round.
inline std::int64_t pulsesBetween(std::int64_t from, std::int64_t to, int bits) {
  const std::uint64_t period = std::uint64_t{1} << bits;
  const std::uint64_t difference =
      (static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from)) & (period - 1);
  if (difference < period / 2) return static_cast<std::int64_t>(difference);
  return -static_cast<std::int64_t>(period - difference);
}

}  // namespace stereo_nav::odometry
