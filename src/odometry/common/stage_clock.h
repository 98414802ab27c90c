#pragma once

#include <chrono>
#include <vector>

#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::odometry {

/// Appends the time since the previous lap, or since the start. Only reported, never decided on.
class StageClock {
 public:
  explicit StageClock(std::vector<StageTime>& times) : times_(times), last_(Clock::now()) {}

  void lap(const char* stage) {
    const auto now = Clock::now();
    times_.push_back({stage, std::chrono::duration<double, std::milli>(now - last_).count()});
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<StageTime>& times_;
  Clock::time_point last_;
};

}  // namespace stereo_nav::odometry
