#pragma once

#include "navigation/planner/grid_search.h"
#include "navigation/planner/shortcut.h"

namespace stereo_nav::navigation {

/// How the published work plans, for comparison.
struct PublishedParams {
  Heuristic heuristic = Heuristic::kManhattan;
  double first_weight = 2.5;  ///< of the estimate; it falls to 1 while the search is repeated
  double weight_step = 0.5;
  int thin_every = 20;  ///< points
};

/// The path through cells that the last of these searches finds, before it is thinned. Any weight above 1 and
/// the Manhattan estimate are inadmissible: the path may be longer than the shortest.
GridPath publishedPath(const cv::Mat& obstacles, grid::Cell start, grid::Cell goal,
                       const PublishedParams& params);

}  // namespace stereo_nav::navigation
