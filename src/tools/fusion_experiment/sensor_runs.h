#pragma once

#include <array>
#include <string>
#include <vector>

#include "estimation/ekf/measurement.h"
#include "estimation/range_correction/range_corrector.h"
#include "odometry/laser/laser_scan.h"
#include "sim/simulation.h"

namespace stereo_nav::tools {

/// Added to the simulator's times, since the filter takes 0 for a stamp that is not set.
constexpr double kStart_s = 1000.0;

/// A measurement without its channel, and when the robot's computer would have it.
struct Sensed {
  double received_s;
  estimation::Measurement measurement;
};

/// What the sensors of a robot say on one drive. On the robot the laser odometry is helped by wheels and
/// gyroscope, the visual one by the gyroscope: whoever leaves a sensor out must have them without it.
struct SensorRuns {
  std::vector<Sensed> wheels, gyro;
  std::array<std::vector<Sensed>, 4> laser;   ///< [2 * with gyroscope + with wheels]
  std::array<std::vector<Sensed>, 2> stereo;  ///< [with gyroscope]
  std::vector<estimation::RangeReading> ranges;
  grid::OccupancyGrid map;
};

/// Renders the whole drive with so many threads. The scenario needs a drive and an IMU of kind raw.
SensorRuns runSensors(const sim::Simulation& simulation, std::uint64_t seed, int threads);

}  // namespace stereo_nav::tools
