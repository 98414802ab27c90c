#pragma once

#include <cstdint>
#include <vector>

#include "estimation/range_correction/range_corrector.h"
#include "odometry/laser/laser_scan.h"
#include "sim/scene.h"
#include "sim/trajectory.h"

namespace stereo_nav::tools {

constexpr double kRangingHeight_m = 0.2;  ///< of the laser and of the range finders above the floor
constexpr double kRangePeriod_s = 0.1;    ///< of each range finder

/// Scans of an RPLiDAR A1 above the base's origin: 360 beams at 10 Hz, each taken at its own time, up to 12
/// m; noise of 5 mm or 1 %, whichever is more; 3 % of the beams have no return.
std::vector<odometry::LaserScan> simulateScans(const sim::Scene& scene, const sim::Trajectory& trajectory,
                                               std::uint64_t seed);

/// Readings of four TFmini that look forward, back, left and right, in order of time: noise of 1 cm, and of
/// each a constant error of up to 5 cm. What lies beyond 12 m gives none.
std::vector<estimation::RangeReading> simulateRanges(const sim::Scene& scene,
                                                     const sim::Trajectory& trajectory, std::uint64_t seed);
constexpr std::size_t kRangeFinders = 4;

}  // namespace stereo_nav::tools
