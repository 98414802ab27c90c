#include "navigation/planner/ends.h"

#include <cmath>
#include <limits>

namespace stereo_nav::navigation {
std::vector<grid::Cell> wayOutOfObstacles(const RobotSpace& space, grid::Cell start, int most) {
  std::vector<grid::Cell> way{start};
  const MoveGrid& moves = space.moves();
  while (!space.fitsSomehow(way.back()) || moves.moves[moves.index(way.back())] == 0) {
    if (static_cast<int>(way.size()) > most) return {};
    grid::Cell best = way.back();
    double steepest = 0.0;
    for (const grid::Cell step : kMoveSteps) {
      const grid::Cell next{way.back().x + step.x, way.back().y + step.y};
      if (!space.geometry().contains(next)) continue;
      const double rise = double{space.obstacleDistance(next)} - double{space.obstacleDistance(way.back())};
      const double gradient = rise / std::hypot(step.x, step.y);
      if (gradient <= steepest) continue;
      steepest = gradient;
      best = next;
    }
    if (best == way.back()) return {};
    way.push_back(best);
  }
  return way;
}

cv::Mat_<std::uint8_t> reachableFrom(const MoveGrid& grid, grid::Cell start) {
  cv::Mat_<std::uint8_t> reachable(grid.height, grid.width, std::uint8_t{0});
  std::vector<grid::Cell> open{start};
  reachable(start.y, start.x) = 1;
  while (!open.empty()) {
    const grid::Cell cell = open.back();
    open.pop_back();
    for (unsigned moves = grid.moves[grid.index(cell)]; moves != 0; moves &= moves - 1) {
      const grid::Cell step = kMoveSteps[static_cast<std::size_t>(__builtin_ctz(moves))];
      const grid::Cell next{cell.x + step.x, cell.y + step.y};
      if (reachable(next.y, next.x) != 0) continue;
      reachable(next.y, next.x) = 1;
      open.push_back(next);
    }
  }
  return reachable;
}

grid::Cell nearestCell(const cv::Mat_<std::uint8_t>& reachable, const Eigen::Vector2d& place) {
  grid::Cell nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int y = 0; y < reachable.rows; ++y) {
    for (int x = 0; x < reachable.cols; ++x) {
      if (reachable(y, x) == 0) continue;
      const double distance = (grid::centreInCells({x, y}) - place).squaredNorm();
      if (distance < least) {
        least = distance;
        nearest = {x, y};
      }
    }
  }
  return nearest;
}

std::uint8_t firstMoves(const RobotSpace& space, grid::Cell cell, double heading_rad) {
  if (space.rule() == HeadingRule::kKept) return 0xFF;
  unsigned moves = 0;
  for (unsigned k = 0; k < kMoves; ++k) {
    const Eigen::Vector2d step(kMoveSteps[k].x, kMoveSteps[k].y);
    if (space.fitsTurning(grid::centreInCells(cell), heading_rad, space.headingAlong(step))) moves |= 1U << k;
  }
  return static_cast<std::uint8_t>(moves);
}

}  // namespace stereo_nav::navigation
