#pragma once

#include <vector>

#include "mapping/map/pose_graph.h"

namespace stereo_nav::mapping {

/// Poses near the optimum that need no start: first the rotations, as matrices of any kind that obey
/// R_to = R_from R_from_to in the sense of least squares, each then replaced by the nearest rotation; then
/// the positions, which are linear once the rotations are known (Martinec and Pajdla 2007; Carlone et al.
/// 2015, "Initialization techniques for 3D SLAM", section V). Two sparse linear systems; informations count
/// by their mean for rotation and for translation. The first vertex of each connected part keeps its pose.
/// Edges of weight 0 do not count; without weights all do.
template <class Pose>
std::vector<Pose> chordalStart(const PoseGraph<Pose>& graph, const std::vector<double>& weights = {});

}  // namespace stereo_nav::mapping
