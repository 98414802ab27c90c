#include "grid/occupancy_grid.h"

namespace stereo_nav::grid {

cv::Mat_<std::uint8_t> obstacleMask(const OccupancyGrid& grid, UnknownSpace unknown) {
  cv::Mat_<std::uint8_t> mask(grid.geometry.height, grid.geometry.width);
  updateObstacleMask(grid, unknown, {0, 0, mask.cols, mask.rows}, mask);
  return mask;
}

void updateObstacleMask(const OccupancyGrid& grid, UnknownSpace unknown, const cv::Rect& part,
                        cv::Mat_<std::uint8_t>& mask) {
  const std::uint8_t of_unknown = unknown == UnknownSpace::kAsObstacle ? 1 : 0;
  for (int y = part.y; y < part.br().y; ++y) {
    for (int x = part.x; x < part.br().x; ++x) {
      const std::int8_t value = grid.at({x, y});
      mask(y, x) = value < 0 ? of_unknown : value >= kObstacleFrom ? 1 : 0;
    }
  }
}

}  // namespace stereo_nav::grid
