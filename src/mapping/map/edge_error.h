#pragma once

#include "mapping/map/pose_graph.h"

namespace stereo_nav::mapping {

/// The error of an edge for poses of its vertices, as g2o defines it, D = T_from_to^-1 T_map_from^-1
/// T_map_to: in the plane (x, y, angle) of D; in space the translation of D and the vector part of its
/// quaternion with w >= 0 (Kuemmerle et al. 2011, "g2o: A general framework for graph optimization").
template <class Pose>
typename Motion<Pose>::Vector edgeError(const GraphEdge<Pose>& edge, const Pose& T_map_from,
                                        const Pose& T_map_to);

/// Its derivatives with respect to the poses: translations move along the axes of the map, rotations turn
/// about the vertex's own axes, T = (t + dt, R exp(dr)).
template <class Pose>
struct EdgeJacobians {
  typename Motion<Pose>::Matrix from, to;
};
template <class Pose>
EdgeJacobians<Pose> edgeJacobians(const GraphEdge<Pose>& edge, const Pose& T_map_from, const Pose& T_map_to);

/// Squared error weighed by the information.
template <class Pose>
double chiSquare(const PoseGraph<Pose>& graph, const GraphEdge<Pose>& edge);
/// Sum over all edges, each times its weight; without weights each counts once.
template <class Pose>
double chiSquare(const PoseGraph<Pose>& graph, const std::vector<double>& weights = {});

}  // namespace stereo_nav::mapping
