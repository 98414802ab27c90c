#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "grid/footprint.h"
#include "grid/occupancy_grid.h"
#include "navigation/planner/plan.h"

namespace stereo_nav::tools {

/// A picture (CV_8UC3) of a path on its map: obstacles black, floor white, unknown grey, the robot's outline
/// at each pose, the start green and the goal red. The origin of the grid is at the lower left.
cv::Mat drawPath(const grid::OccupancyGrid& map, const grid::Footprint& footprint,
                 const std::vector<navigation::PlanarPose>& poses);

}  // namespace stereo_nav::tools
