#pragma once

#include <string>
#include <vector>

#include "stereo_nav/core/trajectory.h"

namespace stereo_nav::tools {

/// One scan of a laser whose beams are all taken at `time_s`.
struct LaserScanReading {
  double time_s;
  std::vector<float> ranges_m;  ///< from right to left; infinite without a return (REP-117)
};

/// A recording of a planar laser and of wheel odometry, with a reference that a SLAM system corrected.
struct LaserSequence {
  double angle_min_rad;
  double angle_increment_rad;
  double range_min_m;
  double range_max_m;
  std::vector<LaserScanReading> scans;
  Trajectory wheels;         ///< base_link in the frame where its wheels began
  Trajectory reference;      ///< base_link in the corrected map, one pose a scan
  std::size_t repeated = 0;  ///< scans left out, since their stamp is not later than the one before
};

/// A CARMEN log, plain or compressed with gzip, whose FLASER lines hold corrected poses: both of their pose
/// triples, and the ODOM line with stamp 0 that follows. Wheel odometry is the composition of the increments
/// between ODOM lines; one with stamp 0 is no motion but the start of the next increment. Beams cover 180
/// degrees to the front; the laser sits at the robot's origin. Times count from kStartTime_s. Throws
/// InputError.
LaserSequence readCarmen(const std::string& log_file);

/// Writes `scan`, `wheel/odom`, `ground_truth/odom` (in frames::kCorrectedMap) and `tf_static`. Equal input
/// gives equal bytes. Throws InputError.
void writeLaserBag(const LaserSequence& sequence, const std::string& path);

}  // namespace stereo_nav::tools
