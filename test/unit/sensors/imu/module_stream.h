#pragma once

#include <cstdint>
#include <vector>

namespace stereo_nav::imu {

// The module of the thesis: a frame of angles each 10 ms.
constexpr int kBaud = 115200;
constexpr double kPeriod_s = 0.01;

using Bytes = std::vector<std::uint8_t>;

inline void append(Bytes& to, const Bytes& bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

}  // namespace stereo_nav::imu
