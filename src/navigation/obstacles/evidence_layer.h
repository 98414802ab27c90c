#pragma once

#include <cstdint>
#include <vector>

#include "grid/occupancy_grid.h"

namespace stereo_nav::navigation {

/// What one kind of sensor has seen of the cells around the robot: log odds of being occupied (Elfes 1989) in
/// small whole numbers, limited, so that what has gone fades within a few looks. Cells have fixed places in
/// the world; the window follows the robot by whole cells.
class EvidenceLayer {
 public:
  /// What lies within `near_cells` of the middle of the window, where the robot is, is remembered for
  /// `near_memory_s`: the sensors may not see it any more, and it has not gone for that.
  EvidenceLayer(int side_cells, double memory_s, int near_cells = 0, double near_memory_s = 0.0);

  void clearAll();
  /// Moves the window by so many cells; what leaves it is forgotten.
  void shift(grid::Cell by);

  /// Begins a look at a time: within it, each cell counts once, and what is seen occupied in it is not seen
  /// free.
  void beginLook(double time_s);
  void seeOccupied(grid::Cell cell);
  void seeFree(grid::Cell cell);
  /// Ends the look, and forgets what was not looked at for long.
  void endLook();

  enum class State : std::uint8_t { kUnknown, kFree, kOccupied };
  State state(std::size_t cell) const;

 private:
  struct Cell {
    std::int8_t log_odds = 0;
    std::uint8_t look = 0;  ///< what this look has seen: bit 0 free, bit 1 occupied
    float seen_s = -1e9F;   ///< since the first look
  };
  bool contains(grid::Cell cell) const {
    return cell.x >= 0 && cell.y >= 0 && cell.x < side_ && cell.y < side_;
  }
  bool isNear(std::size_t cell) const;
  Cell& at(grid::Cell cell) { return cells_[static_cast<std::size_t>(cell.y * side_ + cell.x)]; }

  int side_;
  double memory_s_;
  int near_cells_;
  double near_memory_s_;
  double first_s_ = 0.0, now_s_ = 0.0;
  bool any_look_ = false;
  std::vector<Cell> cells_, shifted_;
};

}  // namespace stereo_nav::navigation
