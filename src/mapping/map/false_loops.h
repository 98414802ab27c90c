#pragma once

#include <cstdint>
#include <vector>

#include "mapping/map/pose_graph.h"

namespace stereo_nav::mapping {

/// Adds loops that are wrong, `share` times as many as there are loops, as a recogniser of places finds them
/// where places look alike: two vertices drawn uniformly, at least ten apart, that are said to stand within
/// half a metre along each axis of each other, turned about the vertical by any angle, with the information
/// of a true loop drawn likewise. The same seed gives the same loops. Returns the first of the edges that
/// were added.
template <class Pose>
std::size_t addFalseLoops(PoseGraph<Pose>& graph, double share, std::uint64_t seed);

}  // namespace stereo_nav::mapping
