#pragma once

#include <cstdint>
#include <vector>

#include "kinematics/drive_params.h"
#include "sim/trajectory.h"

namespace stereo_nav::sim {

/// How the simulated wheels differ from those of the rig file.
struct WheelModelParams {
  double rate_hz = 50.0;
  double latency_ms = 0.0;
  double slip_sigma_m = 0.0;
  double radius_sigma = 0.0;
  double position_sigma_m = 0.0;

  void describe(ParameterVisitor& visitor);
};

/// Counters and steering angles at one time.
struct SimulatedTicks {
  double time_s;  ///< stamp: `latency_ms` after the counters were read
  std::vector<std::int64_t> pulses;
  std::vector<double> steering_rad;  ///< empty without steered wheels
};

/// The true wheels: radii and positions as drawn from the seed about those of the rig file. Those of plain
/// wheels move across alone, since they must stay on one axle.
kinematics::DriveParams trueDrive(const WheelModelParams& params, const kinematics::DriveParams& nominal,
                                  std::uint64_t seed);

/// All readings of the counters on a drive by wheels of this true geometry. Throws InputError for a motion
/// that this drive cannot make, such as a car's turn on the spot. Deterministic in `seed`.
std::vector<SimulatedTicks> simulateWheels(const WheelModelParams& params,
                                           const kinematics::DriveParams& true_drive,
                                           const Trajectory& trajectory, std::uint64_t seed);

}  // namespace stereo_nav::sim
