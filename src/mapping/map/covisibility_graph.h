#pragma once

#include <vector>

#include "mapping/map/visual_map.h"

namespace stereo_nav::mapping {

/// Two keyframes, by their positions in the map, and how many landmarks both see.
struct CovisibilityEdge {
  std::size_t first = 0, second = 0;  ///< first < second
  std::size_t shared = 0;
};

/// The covisibility graph (Mur-Artal et al. 2015, "ORB-SLAM", section III-D): keyframes that share at least
/// so many landmarks; in order of their positions.
std::vector<CovisibilityEdge> covisibilityGraph(const VisualMap& map, std::size_t least_shared = 15);

/// The spanning tree: of these edges those of a tree, or of one tree for each connected part, that share most
/// (Kruskal 1956); the most shared first.
std::vector<CovisibilityEdge> spanningTree(std::size_t keyframes, std::vector<CovisibilityEdge> edges);

}  // namespace stereo_nav::mapping
