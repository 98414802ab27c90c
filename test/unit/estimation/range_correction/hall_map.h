#pragma once

#include "grid/occupancy_grid.h"

namespace stereo_nav::estimation::test {

/// A hall whose floor reaches from (0, 0) to (8, 5) m, with walls of two cells of 0.05 m around it and a
/// square pillar from (5, 3) to (5.6, 3.6) m.
inline grid::OccupancyGrid hallMap() {
  grid::GridGeometry geometry;
  geometry.width = 164;
  geometry.height = 104;
  geometry.origin_x_m = geometry.origin_y_m = -0.1;
  grid::OccupancyGrid map(geometry, grid::kFree);
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const Eigen::Vector2d p = geometry.centreOf({x, y});
      const bool floor = p.x() > 0.0 && p.x() < 8.0 && p.y() > 0.0 && p.y() < 5.0;
      const bool pillar = p.x() > 5.0 && p.x() < 5.6 && p.y() > 3.0 && p.y() < 3.6;
      if (!floor || pillar) map.at({x, y}) = grid::kOccupied;
    }
  }
  return map;
}

}  // namespace stereo_nav::estimation::test
