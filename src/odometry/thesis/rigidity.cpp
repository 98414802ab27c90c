#include "odometry/thesis/rigidity.h"

#include <cmath>

namespace stereo_nav::odometry {

void RigidityParams::describe(ParameterVisitor& visitor) {
  visitEnum(visitor, "test", test, {{"distance", Test::kDistance}, {"per_axis", Test::kPerAxis}},
            "what must not change between two features: their distance, or each axis of their difference");
  visitor.real("threshold_m", threshold_m, {1e-4, 10.0}, "m", "largest change that still counts as rigid");
}

ConsistencyGraph buildRigidityGraph(const RigidityParams& params, const std::vector<Eigen::Vector3d>& before,
                                    const std::vector<Eigen::Vector3d>& now) {
  ConsistencyGraph graph(before.size());
  const double threshold_m = params.threshold_m;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t j = i + 1; j < before.size(); ++j) {
      const Eigen::Vector3d difference_before = before[i] - before[j];
      const Eigen::Vector3d difference_now = now[i] - now[j];
      const bool rigid = params.test == RigidityParams::Test::kDistance
                             ? std::abs(difference_now.norm() - difference_before.norm()) < threshold_m
                             : ((difference_before - difference_now).array().abs() < threshold_m).all();
      if (rigid) graph.connect(i, j);
    }
  }
  return graph;
}

}  // namespace stereo_nav::odometry
