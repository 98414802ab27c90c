#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "grid/occupancy_grid.h"

namespace stereo_nav::navigator {

/// The grid on which ways are planned: a map, or a blank grid where there is none, with what has been seen on
/// the way. What is seen stays until the place is seen free, or until it is to be forgotten: a dead end is
/// remembered when the robot has turned away from it.
///
/// A wall of the map stays a wall, whatever is seen: the local grid sees through glass. An unknown place of
/// the map that is seen free is free.
class PlanningGrid {
 public:
  /// Takes a map; what was seen is forgotten.
  void setMap(const grid::OccupancyGrid& map);
  /// Takes a blank grid instead, all of it free, that holds both points and `margin_m` around them; keeps the
  /// present one when that is blank and holds the points already. Returns whether it is a new one.
  bool setBlank(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double margin_m, double resolution_m);

  /// Takes over what a local grid shows; `T_map_odom` takes coordinates of the local grid's frame to those of
  /// the map. Returns the part of the grid that holds all changes; empty where there is none.
  cv::Rect see(const grid::OccupancyGrid& local, const Eigen::Isometry2d& T_map_odom);
  /// Forgets all that was seen.
  void forgetSeen();

  const grid::OccupancyGrid& grid() const { return merged_; }
  bool empty() const { return merged_.cells.empty(); }
  bool blank() const { return blank_; }

 private:
  /// The part of the grid into which a local grid reaches.
  cv::Rect reachOf(const grid::OccupancyGrid& local, const Eigen::Isometry2d& T_map_odom) const;
  void set(grid::Cell cell, std::int8_t seen, cv::Rect& changed);

  grid::OccupancyGrid map_, merged_;
  bool blank_ = false;
};

}  // namespace stereo_nav::navigator
