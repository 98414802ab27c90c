#pragma once

#include <cmath>
#include <cstdint>

#include "core/angles.h"

namespace stereo_nav::sim {

/// Counter-based random numbers: a draw is a pure function of (key, counter), so that results do not depend
/// on the order of drawing nor on the number of threads. The mixing function is the finaliser of SplitMix64
/// (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014).
inline std::uint64_t mixBits(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

/// A key for a stream of its own, e.g. streamKey(seed, Stream::kNoise, camera, frame).
template <class... Parts>
std::uint64_t streamKey(std::uint64_t seed, Parts... parts) {
  std::uint64_t key = mixBits(seed);
  ((key = mixBits(key ^ static_cast<std::uint64_t>(parts))), ...);
  return key;
}

/// A number in [0, 1).
inline double uniformDraw(std::uint64_t key, std::uint64_t counter) {
  return static_cast<double>(mixBits(key + 0xD1342543DE82EF95ull * counter) >> 11) * 0x1.0p-53;
}

/// Mean 0, standard deviation 1 (Box and Muller).
inline double normalDraw(std::uint64_t key, std::uint64_t counter) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniformDraw(key, 2 * counter)));
  return radius * std::cos(2.0 * kPi * uniformDraw(key, 2 * counter + 1));
}

/// Draws in sequence from one stream, for uses whose order is fixed.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t key) : key_(key) {}
  double uniform(double from, double to) { return from + (to - from) * uniformDraw(key_, counter_++); }
  double normal() { return normalDraw(key_ ^ 0x5851F42D4C957F2Dull, counter_++); }

 private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

/// The uses of random numbers; no two uses share a stream.
enum class Stream : std::uint64_t {
  kTexture = 1,
  kClutter,
  kClock,
  kPixelNoise,
  kImu,
  kLight,
  kWheelGeometry,
  kWheelSlip,
  kCalibration,
  kLaser,
  kRange,
  kFix
};

}  // namespace stereo_nav::sim
