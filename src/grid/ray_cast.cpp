#include "grid/ray_cast.h"

namespace stereo_nav::grid {

RayHit castRay(const OccupancyGrid& grid, const Eigen::Vector2d& p_map, double direction_rad, double range_m,
               std::int8_t occupied_from) {
  const Eigen::Vector2d end =
      p_map + range_m * Eigen::Vector2d(std::cos(direction_rad), std::sin(direction_rad));
  RayHit result;
  result.distance_m = range_m;
  bool was_inside = false;
  traverse(grid.geometry.inCells(p_map), grid.geometry.inCells(end), [&](Cell cell, double share) {
    if (!grid.geometry.contains(cell)) return !was_inside;  // a ray that left a rectangle never returns
    was_inside = true;
    if (grid.at(cell) < occupied_from) return true;
    result = {share * range_m, true, cell};
    return false;
  });
  return result;
}

}  // namespace stereo_nav::grid
