#pragma once

#include <Eigen/Core>
#include <vector>

#include "odometry/common/consistency_graph.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::odometry {

struct RigidityParams {
  enum class Test {
    kDistance,  ///< | |w_i - w_j|_now - |w_i - w_j|_before | < threshold: the thesis' text, Howard 2008
    kPerAxis,   ///< |(w_i - w_j)_before[k] - (w_i - w_j)_now[k]| < threshold for k = x, y, z: the thesis'
                ///< listing, not invariant to rotation
  };
  Test test = Test::kDistance;
  double threshold_m = 0.08;

  void describe(ParameterVisitor& visitor);
};

/// Which pairs of features kept their mutual distance between two frames (thesis, step 4). `before[n]` and
/// `now[n]` are the same feature in the two camera frames, m.
ConsistencyGraph buildRigidityGraph(const RigidityParams& params, const std::vector<Eigen::Vector3d>& before,
                                    const std::vector<Eigen::Vector3d>& now);

}  // namespace stereo_nav::odometry
