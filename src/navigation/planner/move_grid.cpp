#include "navigation/planner/move_grid.h"

namespace stereo_nav::navigation {

MoveGrid movesOfPoint(const cv::Mat& obstacles) {
  MoveGrid grid;
  grid.width = obstacles.cols;
  grid.height = obstacles.rows;
  grid.moves.assign(obstacles.total(), 0);
  cv::Mat_<std::uint8_t> framed;  // so that every cell has eight neighbours
  cv::copyMakeBorder(obstacles, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(1));
  const auto is_free = [&](int x, int y) { return framed(y + 1, x + 1) == 0; };
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (!is_free(x, y)) continue;
      unsigned moves = 0;
      for (int k = 0; k < kMoves; ++k) {
        const grid::Cell step = kMoveSteps[static_cast<std::size_t>(k)];
        if (is_free(x + step.x, y + step.y) && is_free(x + step.x, y) && is_free(x, y + step.y))
          moves |= 1U << k;
      }
      grid.moves[grid.index({x, y})] = static_cast<std::uint8_t>(moves);
    }
  }
  return grid;
}

}  // namespace stereo_nav::navigation
