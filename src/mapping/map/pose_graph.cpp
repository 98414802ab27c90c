#include "mapping/map/pose_graph.h"

#include <algorithm>
#include <cstdlib>

namespace stereo_nav::mapping {
namespace {

bool isOdometry(std::size_t from, std::size_t to) {
  return from + 1 == to || to + 1 == from;
}

/// For each vertex the edges that touch it, odometry first.
template <class Pose>
std::vector<std::vector<std::size_t>> edgesOfVertices(const PoseGraph<Pose>& graph) {
  std::vector<std::vector<std::size_t>> touching(graph.poses.size());
  for (const bool odometry : {true, false}) {
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
      const auto& edge = graph.edges[e];
      if (isOdometry(edge.from, edge.to) != odometry) continue;
      touching[edge.from].push_back(e);
      touching[edge.to].push_back(e);
    }
  }
  return touching;
}

/// Visits each vertex once, breadth first; `reach(edge, vertex)` says by which edge, and returns whether this
/// edge leads there.
template <class Pose, class Begin, class Reach>
void walk(const PoseGraph<Pose>& graph, const Begin& begin, const Reach& reach) {
  const auto touching = edgesOfVertices(graph);
  std::vector<bool> seen(graph.poses.size(), false);
  std::vector<std::size_t> queue;
  for (std::size_t first = 0; first < seen.size(); ++first) {
    if (seen[first]) continue;
    begin(first);
    seen[first] = true;
    queue.assign(1, first);
    for (std::size_t next = 0; next < queue.size(); ++next) {
      for (const std::size_t e : touching[queue[next]]) {
        const auto& edge = graph.edges[e];
        const std::size_t other = edge.from == queue[next] ? edge.to : edge.from;
        if (seen[other] || !reach(e, other)) continue;
        seen[other] = true;
        queue.push_back(other);
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
