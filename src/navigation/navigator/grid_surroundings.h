#pragma once

#include <memory>
#include <utility>

#include "grid/occupancy_grid.h"
#include "navigation/navigator/surroundings.h"

namespace stereo_nav::navigator {

/// A local grid in the frame odom as the navigator asks for it.
class GridSurroundings : public Surroundings {
 public:
  explicit GridSurroundings(std::shared_ptr<const grid::OccupancyGrid> grid)
      : grid_(std::move(grid)), T_grid_odom_(grid_->geometry.T_map_grid().inverse()) {}

  /// Places beyond the edge are unseen.
  Place at(const Eigen::Vector2d& p_odom) const override {
    const grid::Cell cell = grid::cellHolding(T_grid_odom_ * p_odom / grid_->geometry.resolution_m);
    if (!grid_->geometry.contains(cell) || grid_->at(cell) == grid::kUnknown) return Place::kUnseen;
    return grid_->at(cell) >= grid::kObstacleFrom ? Place::kOccupied : Place::kFree;
  }
  const std::shared_ptr<const grid::OccupancyGrid>& grid() const { return grid_; }

 private:
  std::shared_ptr<const grid::OccupancyGrid> grid_;
  Eigen::Isometry2d T_grid_odom_;
};

}  // namespace stereo_nav::navigator
