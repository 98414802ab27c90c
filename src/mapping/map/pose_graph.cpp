#include "mapping/map/pose_graph.h"

#include <algorithm>
#include <cstdlib>

namespace stereo_nav::mapping {
namespace {

bool isOdometry(std::size_t from, std::size_t to) {
  return from + 1 == to || to + 1 == from;
}

/// For each vertex the edges of one kind that touch it.
template <class Pose>
std::vector<std::vector<std::size_t>> edgesOfVertices(const PoseGraph<Pose>& graph, bool odometry) {
  std::vector<std::vector<std::size_t>> touching(graph.poses.size());
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const auto& edge = graph.edges[e];
    if (isOdometry(edge.from, edge.to) != odometry) continue;
    touching[edge.from].push_back(e);
    touching[edge.to].push_back(e);
  }
  return touching;
}

/// Visits each vertex once, from the first of each connected part, along odometry as far as it goes and then
/// by one other edge. `begin(vertex)` begins a part; `reach(edge, vertex)` says by which edge a vertex is
/// found, and returns whether this edge leads there.
template <class Pose, class Begin, class Reach>
void walk(const PoseGraph<Pose>& graph, const Begin& begin, const Reach& reach) {
  const auto by_odometry = edgesOfVertices(graph, true), by_loops = edgesOfVertices(graph, false);
  std::vector<bool> seen(graph.poses.size(), false);
  std::vector<std::size_t> found;
  const auto follow = [&](std::size_t vertex, const std::vector<std::size_t>& edges) {
    for (const std::size_t e : edges) {
      const std::size_t other = graph.edges[e].from == vertex ? graph.edges[e].to : graph.edges[e].from;
      if (seen[other] || !reach(e, other)) continue;
      seen[other] = true;
      found.push_back(other);
    }
  };
  for (std::size_t first = 0; first < seen.size(); ++first) {
    if (seen[first]) continue;
    begin(first);
    seen[first] = true;
    found.assign(1, first);
    for (std::size_t odometry = 0, loops = 0; loops < found.size();) {
      if (odometry < found.size()) {
        const std::size_t vertex = found[odometry++];
        follow(vertex, by_odometry[vertex]);
      } else {
        const std::size_t vertex = found[loops++];
        follow(vertex, by_loops[vertex]);
      }
    }
  }
}

}  // namespace

template <class Pose>
std::vector<std::size_t> odometryOf(const PoseGraph<Pose>& graph) {
  std::vector<std::size_t> odometry(graph.poses.size(), graph.edges.size());
  for (std::size_t e = graph.edges.size(); e-- > 0;) {
    const auto& edge = graph.edges[e];
    if (isOdometry(edge.from, edge.to)) odometry[std::min(edge.from, edge.to)] = e;
  }
  return odometry;
}

template <class Pose>
std::vector<bool> loopsOf(const PoseGraph<Pose>& graph) {
  std::vector<bool> loops(graph.edges.size(), true);
  for (const std::size_t e : odometryOf(graph))
    if (e < loops.size()) loops[e] = false;
  return loops;
}

template <class Pose>
void chainPoses(PoseGraph<Pose>& graph) {
  walk(
      graph, [](std::size_t) {},
      [&graph](std::size_t e, std::size_t vertex) {
        const auto& edge = graph.edges[e];
        graph.poses[vertex] = vertex == edge.to ? graph.poses[edge.from] * edge.T_from_to
                                                : graph.poses[edge.to] * edge.T_from_to.inverse();
        return true;
      });
}

template <class Pose>
std::vector<bool> anchorsOf(const PoseGraph<Pose>& graph, const std::vector<double>& weights) {
  std::vector<bool> anchors(graph.poses.size(), false);
  walk(
      graph, [&anchors](std::size_t first) { anchors[first] = true; },
      [&weights](std::size_t e, std::size_t) { return weights.empty() || weights[e] > 0.0; });
  return anchors;
}

template std::vector<std::size_t> odometryOf(const PlanarGraph&);
template std::vector<std::size_t> odometryOf(const SpatialGraph&);
template std::vector<bool> loopsOf(const PlanarGraph&);
template std::vector<bool> loopsOf(const SpatialGraph&);
template void chainPoses(PlanarGraph&);
template void chainPoses(SpatialGraph&);
template std::vector<bool> anchorsOf(const PlanarGraph&, const std::vector<double>&);
template std::vector<bool> anchorsOf(const SpatialGraph&, const std::vector<double>&);

}  // namespace stereo_nav::mapping
