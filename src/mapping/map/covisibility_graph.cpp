#include "mapping/map/covisibility_graph.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>

namespace stereo_nav::mapping {

std::vector<CovisibilityEdge> covisibilityGraph(const VisualMap& map, std::size_t least_shared) {
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> seen_by;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> shared;
  for (std::size_t k = 0; k < map.keyframes.size(); ++k) {
    for (const vision::KeyframeCorner& corner : map.keyframes[k].keyframe.corners) {
      if (corner.landmark_id == 0) continue;
      std::vector<std::size_t>& before = seen_by[corner.landmark_id];
      if (!before.empty() && before.back() == k) continue;
      for (const std::size_t other : before) ++shared[{other, k}];
      before.push_back(k);
    }
  }
  std::vector<CovisibilityEdge> edges;
  for (const auto& [pair, count] : shared)
    if (count >= least_shared) edges.push_back({pair.first, pair.second, count});
  return edges;
}

std::vector<CovisibilityEdge> spanningTree(std::size_t keyframes, std::vector<CovisibilityEdge> edges) {
  std::stable_sort(edges.begin(), edges.end(),
                   [](const CovisibilityEdge& a, const CovisibilityEdge& b) { return a.shared > b.shared; });
  std::vector<std::size_t> parent(keyframes);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&parent](std::size_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  std::vector<CovisibilityEdge> tree;
  for (const CovisibilityEdge& edge : edges) {
    const std::size_t a = root(edge.first), b = root(edge.second);
    if (a == b) continue;
    parent[std::max(a, b)] = std::min(a, b);
    tree.push_back(edge);
  }
  return tree;
}

}  // namespace stereo_nav::mapping
