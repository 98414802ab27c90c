#pragma once

#include <vector>

#include "grid/footprint.h"
#include "sim/driven_params.h"
#include "sim/scene.h"

namespace stereo_nav::sim {

/// What of a driven robot touches things: a rectangle about base_link, up to a height. It stops at what
/// stands in its way; what is movable it pushes along the normal of the contact, quasi-statically and without
/// turning it, unless that stands against something itself.
class DrivenBody {
 public:
  explicit DrivenBody(const DrivenParams& params);

  /// Whether the robot may move so at `time_s`; pushes what it may push. A motion that leads out of what it
  /// is in is always free.
  bool tryMotion(Scene& scene, const Eigen::Isometry2d& T_before, const Eigen::Isometry2d& T_after,
                 double time_s);
  /// Holds for `step_s` those who would walk towards a robot that stands and are as near as they wait.
  void holdWalkers(Scene& scene, const Eigen::Isometry2d& T_world_base, double time_s, double step_s) const;
  /// The solids that it touched with the last motion, by their index.
  const std::vector<std::size_t>& touched() const { return touched_; }

 private:
  bool concerns(const Solid& solid, double time_s) const;
  bool tryPush(Scene& scene, std::size_t pushed, const Eigen::Vector2d& way_m, double time_s) const;

  DrivenParams params_;
  grid::Footprint footprint_;
  std::vector<std::size_t> touched_;
};

}  // namespace stereo_nav::sim
