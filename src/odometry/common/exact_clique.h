#pragma once

#include <cstddef>
#include <vector>

#include "odometry/common/consistency_graph.h"

namespace stereo_nav::odometry {

/// Indices into the graph.
struct CliqueResult {
  std::vector<std::size_t> members;  ///< in increasing order
  bool optimal;                      ///< the search ended before its budget did
  std::size_t expanded;              ///< nodes of the search tree
};

/// The largest clique by branch and bound on bit sets with a greedy colouring as the bound (Tomita and Seki
/// 2003; San Segundo, Rodriguez-Losada and Jimenez 2011), started from the greedy one. After `budget`
/// expanded nodes the best so far is returned: counted, not timed, so that results repeat.
CliqueResult largestClique(const ConsistencyGraph& graph, std::size_t budget);

}  // namespace stereo_nav::odometry
