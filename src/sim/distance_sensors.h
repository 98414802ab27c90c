#pragma once

#include <optional>

#include "sim/driven_params.h"
#include "sim/motion_history.h"
#include "sim/random.h"
#include "sim/scene.h"

namespace stereo_nav::sim {

/// A turning laser on a driven robot: each beam is measured at its own time, from where the robot is then.
class LaserModel {
 public:
  LaserModel(const LaserModelParams& params, const LaserRig& rig, std::uint64_t seed);

  /// Measures the beams that are due until the end of the motion; returns the revolution when it is complete.
  /// Calls must not be a revolution apart. `time_s` of the scan is simulation time.
  std::optional<laser::Scan> advance(const Scene& scene, const MotionHistory& motion);

 private:
  float measure(const Scene& scene, const MotionHistory& motion, double time_s, std::size_t beam);

  LaserModelParams params_;
  LaserRig rig_;
  RandomStream random_;
  std::uint64_t revolutions_ = 0;
  laser::Scan scan_;  ///< as far as it is measured
};

/// What a range finder measures: the nearest thing in its cone, by REP-117.
double measureRange(const RangeModelParams& params, const RangeRig& rig, const Scene& scene,
                    const Eigen::Isometry3d& T_world_base, double time_s, RandomStream& random);

}  // namespace stereo_nav::sim
