#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "odometry/laser/cell_grid.h"

namespace stereo_nav::odometry {

/// A piece of a wall around a place of the map.
struct MapLine {
  Eigen::Vector2d centre;
  Eigen::Vector2d normal;       ///< of length 1
  double across_m2;             ///< variance of the points across the line
  double centre_variance_m2;    ///< of the centre across the line
  double normal_variance_rad2;  ///< of the normal's direction
  double half_length_m;         ///< standard deviation of the points along the line
  double keyframes;             ///< scans that saw it
};

/// The last keyframes as lines. A pyramid of grids holds the moments (number, sum, sum of squares) of the
/// points in each cell, so that a scan is added or taken out by additions; the line at a place is the
/// principal axis of the three by three cells around it. Which level a point is compared on follows from its
/// noise: the cells must be wide against it for the axis to be that of the wall.
class LineMap {
 public:
  static constexpr int kLevels = 4;

  /// `cell_m` of the finest level; each further one has cells twice as wide.
  LineMap(double cell_m, int keyframes);

  void clear();
  bool empty() const { return scans_.empty(); }
  /// Adds a scan and drops the oldest one beyond the number that is kept.
  void add(const std::vector<Eigen::Vector2d>& points_map);

  /// The coarsest level's index for points of this noise across the wall.
  int levelFor(double sigma_m) const;
  /// The line at `p_map` on `level`, or on the next coarser ones; nothing where the map holds none there.
  const MapLine* lineAt(const Eigen::Vector2d& p_map, int level) const;
  /// Another number after each change.
  std::uint64_t version() const { return changes_; }
  /// Cells in memory, of all levels.
  std::size_t cells() const;
  double cell_m(int level) const { return cell_m_ * static_cast<double>(1 << level); }

  /// The points of the scans that are kept, the oldest scan first.
  const std::deque<std::vector<Eigen::Vector2d>>& scans() const { return scans_; }

 private:
  struct Cell {
    std::optional<MapLine> line;
    bool fitted = false;
    int keyframes = 0;
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;  ///< about the middle of the cell
    std::uint64_t last_change = 0;
  };
  using Grid = CellGrid<Cell>;

  void change(const std::vector<Eigen::Vector2d>& points_map, double sign);
  void forgetEmptyCells(int level);
  void addTo(int level, const Eigen::Vector2d& p_map, double sign);
  std::optional<MapLine> fit(int level, int ix, int iy) const;

  double cell_m_;
  std::size_t most_keyframes_;
  std::uint64_t changes_ = 0;
  mutable std::array<Grid, kLevels> grids_;
  std::array<std::size_t, kLevels> forget_at_{};  ///< number of cells at which the empty ones are taken out
  std::deque<std::vector<Eigen::Vector2d>> scans_;
};

}  // namespace stereo_nav::odometry
