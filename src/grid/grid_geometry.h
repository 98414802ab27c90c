#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace stereo_nav::grid {

/// A cell by its column and row; (0, 0) is the cell at the origin of the grid.
struct Cell {
  int x = 0;
  int y = 0;

  bool operator==(const Cell& other) const { return x == other.x && y == other.y; }
  bool operator!=(const Cell& other) const { return !(*this == other); }
};

/// The cell that holds a place given in cells, and the place of a cell's centre.
inline Cell cellHolding(const Eigen::Vector2d& p_cells) {
  return {static_cast<int>(std::floor(p_cells.x())), static_cast<int>(std::floor(p_cells.y()))};
}
inline Eigen::Vector2d centreInCells(Cell cell) {
  return Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5);
}

/// Where the cells of a grid lie in the frame of the map, as nav_msgs/MapMetaData has it: the lower left
/// corner of cell (0, 0) is the origin, columns run along the x axis of the origin's pose, rows along its y
/// axis.
struct GridGeometry {
  int width = 0;               ///< columns
  int height = 0;              ///< rows
  double resolution_m = 0.05;  ///< side of a cell
  double origin_x_m = 0.0;
  double origin_y_m = 0.0;
  double origin_yaw_rad = 0.0;

  bool contains(Cell cell) const { return cell.x >= 0 && cell.y >= 0 && cell.x < width && cell.y < height; }
  /// Position of a cell in an array of rows; the cell must be inside.
  std::size_t index(Cell cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(cell.x);
  }
  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }

  /// Takes coordinates along columns and rows, in m from the origin, into the frame of the map.
  Eigen::Isometry2d T_map_grid() const {
    Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
    T.linear() = Eigen::Rotation2Dd(origin_yaw_rad).toRotationMatrix();
    T.translation() = Eigen::Vector2d(origin_x_m, origin_y_m);
    return T;
  }
  /// The cell that holds a point of the map; it may lie outside the grid.
  Cell cellAt(const Eigen::Vector2d& p_map) const { return cellHolding(inCells(p_map)); }
  /// A point of the map in units of cells: the centre of cell (0, 0) is (0.5, 0.5).
  Eigen::Vector2d inCells(const Eigen::Vector2d& p_map) const {
    return T_map_grid().inverse() * p_map / resolution_m;
  }
  Eigen::Vector2d fromCells(const Eigen::Vector2d& p_cells) const {
    return T_map_grid() * Eigen::Vector2d(p_cells * resolution_m);
  }
  /// The centre of a cell in the frame of the map.
  Eigen::Vector2d centreOf(Cell cell) const { return fromCells(centreInCells(cell)); }
};

}  // namespace stereo_nav::grid
