#pragma once

#include <string>
#include <vector>

#include "mapping/map/graph_optimiser.h"
#include "mapping/map/mutual_consistency.h"

namespace stereo_nav::mapping {

/// How false loops are told from true ones.
struct RobustParams {
  OptimiserParams optimiser;
  ConsistencyParams consistency;
  double cauchy_chi = 1.0;   ///< where Cauchy's loss begins, in standard deviations
  double confidence = 0.99;  ///< a true loop fits the map with this probability

  void describe(ParameterVisitor& visitor);
};

/// What became of a loop. It stays in the graph whatever that is: the next call judges it anew.
struct LoopVerdict {
  std::size_t edge = 0;
  bool kept = false;
  double chi_square = 0.0;  ///< of the loop against the map that came out
  std::size_t agrees = 0;   ///< with how many loops of the largest consistent set
  std::string reason;       ///< why it was rejected, with numbers; empty where it was kept
};

struct RobustResult {
  OptimiserResult optimiser;       ///< of the last step, with the loops that were kept
  std::vector<LoopVerdict> loops;  ///< in the order of the edges
  std::size_t consistent = 0;      ///< loops of the largest consistent set
  bool largest = false;            ///< whether that set is known to be the largest
};

/// The poses of the graph without its false loops, in steps of which none is enough alone: the largest set of
/// loops that agree with each other (mutual_consistency.h), under Cauchy's loss; other such sets, each taken
/// where that lowers the cost of truncated least squares; then all loops again with weights that go from soft
/// to all or nothing as the error they allow shrinks to the gate (graduated non-convexity for truncated least
/// squares: Yang et al. 2020, eq. 12 and 14), begun at that map instead of with all loops alike; at last
/// those within the gate, as plain least squares.
template <class Pose>
RobustResult optimiseRobustly(PoseGraph<Pose>& graph, const RobustParams& params);

}  // namespace stereo_nav::mapping
