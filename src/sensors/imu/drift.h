#pragma once

#include <vector>

#include "sensors/imu/module_angles.h"

namespace stereo_nav::imu {

/// A module's angles at a time, s on any clock.
struct AngleSample {
  double time_s = 0.0;
  ModuleAngles angles;
};

/// How one angle of a module at rest drifted.
struct AngleDrift {
  double total_deg = 0.0;      ///< mean of the last second minus mean of the first
  double slope_deg_min = 0.0;  ///< slope of the straight line through all samples
  double residual_deg = 0.0;   ///< standard deviation around that line
  double largest_deg = 0.0;    ///< largest distance from the mean of the first second
};

/// The drift of all three angles over a whole recording.
struct DriftReport {
  double duration_s = 0.0;
  AngleDrift yaw, pitch, roll;
};

/// Angles may pass +-180 degrees. The samples must cover more than two seconds and their times must increase;
/// throws std::invalid_argument otherwise.
DriftReport measureDrift(const std::vector<AngleSample>& samples);

}  // namespace stereo_nav::imu
