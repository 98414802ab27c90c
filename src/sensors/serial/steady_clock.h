#pragma once

#include <chrono>

namespace stereo_nav::serial {

/// Seconds of CLOCK_MONOTONIC, the clock of all arrivals and stamps below the nodes.
inline double steadyNow_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace stereo_nav::serial
