#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kinematics/drive_params.h"
#include "stereo_nav/core/trajectory.h"

namespace stereo_nav::tools {

/// All counters of a drive at one time.
struct WheelReading {
  double time_s;
  std::vector<std::int64_t> pulses;
};

/// A recording of wheels alone, with the poses of base_link by motion capture.
struct WheelSequence {
  kinematics::DriveParams drive;  ///< nominal geometry
  std::vector<WheelReading> readings;
  Trajectory ground_truth;
};

/// OptiOdom: `SET_run-NN.csv` (a row each cycle: t s, x m, y m, theta rad, pulses that each wheel counted in
/// the cycle) and beside it `SET_metadata.csv` (drive, gear, encoder, dimensions). Of its drives two
/// are known: `omni3`, three omni wheels at -60, 60 and 180 degrees whose pulses count clockwise, and `diff`,
/// a right and a left wheel. `omni4` and `tricyc` are refused by name. Times count from kStartTime_s. Throws
/// InputError.
WheelSequence readOptiodom(const std::string& run_file);

/// Writes `wheel_ticks` and `ground_truth/odom` (pose of base_link in `world`; twist not given, zero). Equal
/// input gives equal bytes. Throws InputError.
void writeWheelBag(const WheelSequence& sequence, const std::string& path);

}  // namespace stereo_nav::tools
