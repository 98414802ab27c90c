#pragma once

#include <string>
#include <variant>

#include "mapping/map/pose_graph.h"

namespace stereo_nav::mapping {

using AnyGraph = std::variant<PlanarGraph, SpatialGraph>;

/// Reads a pose graph in g2o's text format: lines VERTEX_SE2 id x y angle, EDGE_SE2 from to x y angle and the
/// upper triangle of the information row by row, or VERTEX_SE3:QUAT id x y z qx qy qz qw and EDGE_SE3:QUAT
/// likewise; m, rad. Of lines FIX there may be one: the first vertex is held anyway, which changes no error.
/// A file without vertices gets those of its edges, chained from the origin. Throws InputError with
/// `file:line:` for anything else: planar and spatial lines mixed, vertices twice, edges to vertices that are
/// missing, informations that are not positive definite.
AnyGraph readG2o(const std::string& path);

/// The text of such a file, with 17 digits, so that it reads back as the same numbers.
std::string toG2o(const PlanarGraph& graph);
std::string toG2o(const SpatialGraph& graph);

}  // namespace stereo_nav::mapping
