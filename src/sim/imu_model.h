#pragma once

#include <cstdint>
#include <vector>

#include "sim/random.h"
#include "sim/trajectory.h"
#include "stereo_nav/core/imu_sample.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::sim {

/// The kind of data that the simulated module delivers.
enum class ImuKind {
  kNone,
  kPerfect,  ///< attitude and rates without error
  kThesis,   ///< a module that sends three angles (its yaw drifts), as attitude only
  kRaw       ///< gyro and accelerometer
};

struct ImuParams {
  ImuKind kind = ImuKind::kThesis;
  double rate_hz = 100.0;
  double latency_ms = 5.0;
  // Thesis module.
  double yaw_drift_dps = 2.9 / 600.0;  ///< measured by its author over 600 s at rest
  double power_on_yaw_deg = 20.0;
  double angle_noise_deg = 0.02;
  double quantisation_deg = 0.01;
  // Raw module.
  double gyro_bias_dps = 0.3;
  double gyro_noise_dps_rthz = 0.01;
  double gyro_walk_dps2_rthz = 0.002;
  double accel_bias_mps2 = 0.05;
  double accel_noise_mps2_rthz = 0.004;

  void describe(ParameterVisitor& visitor);
};

/// The module, sample after sample. `imu_link` has the axes of `base_link`. Deterministic in `seed`.
class ImuModel {
 public:
  ImuModel(const ImuParams& params, std::uint64_t seed);

  /// The sample whose values are true at `time_s`, as a driver would stamp it: its `time_s` is when they have
  /// arrived, `latency_ms` later.
  ImuSample sample(const BaseState& state, double time_s);
  /// Of the stamp behind the true time.
  double latency_s() const { return params_.kind == ImuKind::kPerfect ? 0.0 : 1e-3 * params_.latency_ms; }

 private:
  ImuParams params_;
  RandomStream random_;
  Eigen::Vector3d gyro_bias_dps_, accel_bias_;
};

/// All samples of the module, from 0 to `duration_s`, as a driver would stamp them: a sample's `time_s` is
/// when its values have arrived, `latency_ms` after they were true. `imu_link` has the axes of `base_link`.
/// Deterministic in `seed`.
std::vector<ImuSample> simulateImu(const ImuParams& params, const Trajectory& trajectory, double duration_s,
                                   std::uint64_t seed);

}  // namespace stereo_nav::sim
