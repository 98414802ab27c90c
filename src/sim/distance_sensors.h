#pragma once

#include <optional>

#include "sim/driven_params.h"
#include "sim/random.h"
#include "sim/scene.h"
#include "sim/trajectory.h"

namespace stereo_nav::sim {

/// A turning laser on a robot that moves: each beam is measured at its own time, from where the robot is
/// then.
class LaserModel {
 public:
  LaserModel(const LaserModelParams& params, const LaserRig& rig, std::uint64_t seed);

  /// Measures the beams that are due until `now_s`, but no more than to the end of a revolution, which is
  /// returned then. `base` is asked for the times of these beams; `time_s` of the scan is simulation time.
  std::optional<laser::Scan> advance(const Scene& scene, const BasePath& base, double now_s);

 private:
  float measure(const Scene& scene, const BasePath& base, double time_s, std::size_t beam);

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
