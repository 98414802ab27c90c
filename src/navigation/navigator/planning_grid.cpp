#include "navigation/navigator/planning_grid.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::navigator {

void PlanningGrid::setMap(const grid::OccupancyGrid& map) {
  map_ = map;
  merged_ = map;
  blank_ = false;
}

bool PlanningGrid::setBlank(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double margin_m,
                            double resolution_m) {
  const auto holds = [this](const Eigen::Vector2d& p_map) {
    return merged_.geometry.contains(merged_.geometry.cellAt(p_map));
  };
  if (blank_ && holds(a) && holds(b)) return false;
  const Eigen::Vector2d low = a.cwiseMin(b).array() - margin_m, high = a.cwiseMax(b).array() + margin_m;
  grid::GridGeometry geometry;
  geometry.resolution_m = resolution_m;
  geometry.origin_x_m = low.x();
  geometry.origin_y_m = low.y();
  geometry.width = static_cast<int>(std::ceil((high.x() - low.x()) / resolution_m));
  geometry.height = static_cast<int>(std::ceil((high.y() - low.y()) / resolution_m));
  setMap(grid::OccupancyGrid(geometry, grid::kFree));
  blank_ = true;
  return true;
}

cv::Rect PlanningGrid::see(const grid::OccupancyGrid& local, const Eigen::Isometry2d& T_map_odom) {
  cv::Rect changed;
  const Eigen::Isometry2d T_local_grid =
      local.geometry.T_map_grid().inverse() * T_map_odom.inverse() * map_.geometry.T_map_grid();
  const cv::Rect reach = reachOf(local, T_map_odom);
  for (int y = reach.y; y < reach.br().y; ++y) {
    for (int x = reach.x; x < reach.br().x; ++x) {
      const Eigen::Vector2d p_local =
          T_local_grid * Eigen::Vector2d(map_.geometry.resolution_m * grid::centreInCells({x, y}));
      const grid::Cell cell = grid::cellHolding(p_local / local.geometry.resolution_m);
      if (local.geometry.contains(cell) && local.at(cell) != grid::kUnknown)
        set({x, y}, local.at(cell), changed);
    }
  }
  // Where the cells of the map are larger, none of their centres may lie in an occupied cell of the local
  // grid.
  for (int y = 0; y < local.geometry.height; ++y) {
    for (int x = 0; x < local.geometry.width; ++x) {
      if (local.at({x, y}) < grid::kObstacleFrom) continue;
      const grid::Cell cell = map_.geometry.cellAt(T_map_odom * local.geometry.centreOf({x, y}));
      if (map_.geometry.contains(cell)) set(cell, grid::kOccupied, changed);
    }
  }
  return changed;
}

void PlanningGrid::forgetSeen() {
  merged_ = map_;
}

cv::Rect PlanningGrid::reachOf(const grid::OccupancyGrid& local, const Eigen::Isometry2d& T_map_odom) const {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9), high = -low;
  for (const int x : {0, local.geometry.width}) {
    for (const int y : {0, local.geometry.height}) {
      const Eigen::Vector2d corner =
          map_.geometry.inCells(T_map_odom * local.geometry.fromCells(Eigen::Vector2d(x, y)));
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  const auto column = [this](double x) {
    return static_cast<int>(std::clamp(x, 0.0, 1.0 * map_.geometry.width));
  };
  const auto row = [this](double y) {
    return static_cast<int>(std::clamp(y, 0.0, 1.0 * map_.geometry.height));
  };
  return {cv::Point(column(low.x()), row(low.y())),
          cv::Point(column(std::ceil(high.x())), row(std::ceil(high.y())))};
}

void PlanningGrid::set(grid::Cell cell, std::int8_t seen, cv::Rect& changed) {
  const std::int8_t drawn = map_.at(cell);
  std::int8_t value = grid::kFree;
  if (seen >= grid::kObstacleFrom)
    value = grid::kOccupied;
  else if (drawn >= grid::kObstacleFrom)
    value = drawn;
  if (merged_.at(cell) == value) return;
  merged_.at(cell) = value;
  changed |= cv::Rect(cell.x, cell.y, 1, 1);
}

}  // namespace stereo_nav::navigator
