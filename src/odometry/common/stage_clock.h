#pragma once

#include <chrono>
#include <vector>

#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::odometry {

/// Measures how long the stages of a frame take. These times are only reported; nothing is decided by them.
class StageClock {
 public:
  explicit StageClock(std::vector<StageTime>& times) : times_(times), last_(Clock::now()) {}

  /// Appends the time since the previous lap, or since the start, under the name of a stage.
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
