#pragma once

#include <string>

#include "mapping/map/visual_map.h"
#include "stereo_nav/core/trajectory.h"

namespace stereo_nav::tools {

/// Poses of the keyframes in the map or, with a transform, in the world.
Trajectory keyframePoses(const mapping::VisualMap& map, const Similarity& T_target_map);

/// Landmarks and keyframes as coloured points, in ASCII PLY.
std::string toPly(const mapping::VisualMap& map, const Similarity& T_target_map);

/// What the map holds, in lines.
std::string describe(const mapping::VisualMap& map);

}  // namespace stereo_nav::tools
