#pragma once

#include <cstddef>
#include <vector>

#include "odometry/common/consistency_graph.h"

namespace stereo_nav::odometry {

/// A large clique, grown greedily (thesis, step 5, after Howard 2008): start with the node of highest degree;
/// among the nodes connected to all members, add the one with most connections to the other such nodes; stop
/// when none is left. Of equals the lowest index is taken. Indices in increasing order; empty only for an
/// empty graph.
std::vector<std::size_t> greedyClique(const ConsistencyGraph& graph);

}  // namespace stereo_nav::odometry
