#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "grid/occupancy_grid.h"

namespace stereo_nav::grid {

/// Visits the cells that the line from `from` to `to` runs through, in their order, neighbours by their sides
/// (Amanatides and Woo 1987). Both in cells (GridGeometry::inCells()); they may lie outside the grid.
/// `visit(Cell, double share)` gets the share of the line, 0 to 1, at which it enters the cell, and returns
/// false to stop. Returns false if it was stopped.
template <class Visit>
bool traverse(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Visit& visit) {
  const Eigen::Vector2d way = to - from;
  Cell cell = cellHolding(from);
  const Cell last = cellHolding(to);
  const int step_x = way.x() < 0.0 ? -1 : 1, step_y = way.y() < 0.0 ? -1 : 1;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double per_x = way.x() == 0.0 ? kNever : 1.0 / std::fabs(way.x());
  const double per_y = way.y() == 0.0 ? kNever : 1.0 / std::fabs(way.y());
  double next_x =
      per_x == kNever ? kNever : ((step_x > 0 ? cell.x + 1 - from.x() : from.x() - cell.x) * per_x);
  double next_y =
      per_y == kNever ? kNever : ((step_y > 0 ? cell.y + 1 - from.y() : from.y() - cell.y) * per_y);
  double share = 0.0;
  for (int left = std::abs(last.x - cell.x) + std::abs(last.y - cell.y); visit(cell, share); --left) {
    if (left == 0) return true;
    // The counts of columns and rows that remain guard against the rounding of shares near 1.
    const bool along_x = cell.y == last.y || (cell.x != last.x && next_x < next_y);
    share = std::min(1.0, along_x ? next_x : next_y);
    if (along_x) {
      cell.x += step_x;
      next_x += per_x;
    } else {
      cell.y += step_y;
      next_y += per_y;
    }
  }
  return false;
}

/// What a ray meets.
struct RayHit {
  double distance_m = 0.0;  ///< to the side of the cell that it meets, or `range_m`
  bool hit = false;         ///< false: nothing within the range, or the ray left the grid
  Cell cell;                ///< the one that it meets
};

/// Follows a ray through the map from a point of it until a cell of at least `occupied_from`; unknown cells
/// let it pass.
RayHit castRay(const OccupancyGrid& grid, const Eigen::Vector2d& p_map, double direction_rad, double range_m,
               std::int8_t occupied_from = kObstacleFrom);

}  // namespace stereo_nav::grid
