#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "grid/grid_geometry.h"

namespace stereo_nav::grid {

constexpr std::int8_t kFree = 0;
constexpr std::int8_t kOccupied = 100;
constexpr std::int8_t kUnknown = -1;

/// The content of nav_msgs/OccupancyGrid: 0 (free) to 100 (occupied), or -1 where nothing is known, row by
/// row from the origin.
struct OccupancyGrid {
  GridGeometry geometry;
  std::vector<std::int8_t> cells;

  OccupancyGrid() = default;
  explicit OccupancyGrid(const GridGeometry& geometry_in, std::int8_t value = kUnknown)
      : geometry(geometry_in), cells(geometry_in.size(), value) {}
  std::int8_t at(Cell cell) const { return cells[geometry.index(cell)]; }
  std::int8_t& at(Cell cell) { return cells[geometry.index(cell)]; }
};

/// What a cell of which nothing is known, and all that lies beyond the edge of the grid, counts as. One rule
/// for the whole robot.
enum class UnknownSpace { kAsFree, kAsObstacle };

/// From this value on a cell is an obstacle, as in map_server and move_base.
constexpr std::int8_t kObstacleFrom = 65;

/// The cells that the robot must not touch: CV_8UC1, 1 for an obstacle and 0 for free, row 0 at the origin.
cv::Mat_<std::uint8_t> obstacleMask(const OccupancyGrid& grid, UnknownSpace unknown);
/// The same within `part` only, written into that part of `mask`.
void updateObstacleMask(const OccupancyGrid& grid, UnknownSpace unknown, const cv::Rect& part,
                        cv::Mat_<std::uint8_t>& mask);

}  // namespace stereo_nav::grid
