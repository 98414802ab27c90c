#pragma once

#include <functional>
#include <vector>

namespace stereo_nav::control {

/// One period of a controller of speed: command in mm/s, from the wanted and the measured speed in mm/s.
using SpeedController = std::function<double(double wanted, double measured, double period_s)>;

/// What a loop of speed did on the drive on which such loops are measured: first order with 0.15 s, commands
/// up to 1200 mm/s, 50 Hz. It is asked for 900 mm/s at rest; 2 s later the drive is held for 0.6 s; 2.4 s
/// after that 0 is asked for, for 2 s.
struct SpeedLoopRun {
  struct Sample {
    double time_s, wanted, command, speed;
  };
  std::vector<Sample> samples;      ///< mm/s, each period
  double overshoot_mm_per_s = 0.0;  ///< above 900 mm/s, in the whole run
  double settled_s = 0.0;  ///< from the step until within 2 % for good, before the block; infinite if never
  double settled_after_block_s = 0.0;  ///< the same from the end of the block
  double last_speed_mm_per_s = 0.0;    ///< at the end, where 0 is asked for
};

/// Runs the loop.
SpeedLoopRun runSpeedLoop(const SpeedController& controller);

}  // namespace stereo_nav::control
