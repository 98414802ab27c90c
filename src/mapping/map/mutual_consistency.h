#pragma once

#include <cstddef>
#include <vector>

#include "mapping/map/pose_graph.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::mapping {

struct ConsistencyParams {
  double confidence = 0.99;  ///< two true loops agree with this probability
  int search_budget = 2000;  ///< nodes of the search for a largest set
  int most_sets = 10;        ///< sets that are looked for

  void describe(ParameterVisitor& visitor);
};

/// Which loops agree with each other.
struct ConsistentLoops {
  std::vector<std::size_t> loops;  ///< edges of the graph that were compared
  /// Positions in `loops`: a largest set whose members all agree, then the largest one among all others, and
  /// so on; at least two members each, but for the first one.
  std::vector<std::vector<std::size_t>> sets;
  std::vector<std::size_t>
      agrees;            ///< for each loop with how many members of the first set, itself not counted
  bool largest = false;  ///< whether the budget was enough to know that no set is larger than the first
};

/// Pairwise consistent measurements (Mangelson et al. 2018, "Pairwise consistent measurement set
/// maximization"): two loops agree when the way out along one, back along the other and between their ends
/// along the odometry ends where it began, within the covariances of all four. The largest set whose members
/// all agree is a largest clique. Covariances of the odometry are summed along its edges; that two of its
/// ways may share edges is left out of account. Where two consecutive vertices have no edge, nothing is known
/// of the motion between them: loops across such a gap are held against each other, not against the odometry.
template <class Pose>
ConsistentLoops consistentLoops(const PoseGraph<Pose>& graph, const ConsistencyParams& params);

}  // namespace stereo_nav::mapping
