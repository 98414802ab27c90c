#include "navigation/planner/published_plan.h"

namespace stereo_nav::navigation {

GridPath publishedPath(const cv::Mat& obstacles, grid::Cell start, grid::Cell goal,
                       const PublishedParams& params) {
  const MoveGrid moves = movesOfPoint(obstacles);
  GridSearch search;
  SearchParams step;
  step.heuristic = params.heuristic;
  for (step.weight = params.first_weight; step.weight > 1.0; step.weight -= params.weight_step) {
    if (!search.find(moves, start, goal, step).found()) return {};
  }
  step.weight = 1.0;
  return search.find(moves, start, goal, step);
}

}  // namespace stereo_nav::navigation
