#pragma once

#include <cstdint>
#include <vector>

#include "navigation/planner/move_grid.h"
#include "navigation/planner/search_params.h"

namespace stereo_nav::navigation {

/// A path from cell to cell, and what finding it took.
struct GridPath {
  std::vector<grid::Cell> cells;  ///< from start to goal; empty: there is none
  double length_cells = 0.0;      ///< straight moves count 1, diagonal ones the square root of 2
  std::size_t expanded = 0;       ///< cells whose neighbours were looked at

  bool found() const { return !cells.empty(); }
};

/// A* on a grid with eight neighbours (Hart, Nilsson, Raphael 1968).
///
/// - The open list is an array of buckets of equal f, last in first out (Dial 1969), so that of equally
/// promising cells the one
///   nearest to the goal comes first. No move between two cells changes f by a little without changing it by
///   half a cell, hence order within a bucket hardly matters; where it does, the cell is opened again, and
///   the search goes on until nothing in the open list can be shorter. The result is optimal.
/// - Where length alone counts, a cell that was entered by move d is left only by moves that no equally short
/// path around it
///   has (Harabor and Grastien 2011, neighbour pruning, here without their jumps): most cells are then looked
///   at once.
/// - Lengths are whole numbers with sqrt(2) = 8119 / 5741, wrong by 1e-8, so that sums are exact. Paths
/// longer than half a
///   million cells are not found.
///
/// Memory: 8 bytes a cell and 12 bytes an entry of the open list, kept from one search to the next.
class GridSearch {
 public:
  /// `start` and `goal` must be inside. `start_moves` are the moves that the robot may begin with (its
  /// heading).
  GridPath find(const MoveGrid& grid, grid::Cell start, grid::Cell goal, const SearchParams& params = {},
                std::uint8_t start_moves = 0xFF);

 private:
  struct Node {
    std::uint32_t g;  ///< shortest way known, valid if `run` is that of this search
    std::uint16_t run;
    std::uint8_t arrival;  ///< the move that led here
    bool closed;
  };
  struct Entry {
    std::uint32_t g;
    std::uint16_t x, y;
    std::int32_t next;  ///< of the same bucket, or of the unused entries
  };

  template <class Heuristic>
  GridPath search(const MoveGrid& grid, grid::Cell start, grid::Cell goal, std::uint8_t start_moves,
                  bool prune, const Heuristic& heuristic);
  void begin(std::size_t cells);
  void push(std::uint32_t f, std::uint32_t g, int x, int y);
  /// The next bucket that holds an entry and whose f is below `best`; false: there is none.
  bool advance(std::uint32_t best);
  Entry pop();
  GridPath trace(const MoveGrid& grid, grid::Cell start, grid::Cell goal) const;

  std::vector<Node> nodes_;
  std::uint16_t run_ = 0;
  std::vector<std::int32_t> heads_;  ///< first entry of each bucket, -1: none
  std::vector<Entry> entries_;
  std::int32_t unused_ = -1;
  std::size_t bucket_ = 0, last_bucket_ = 0;
};

}  // namespace stereo_nav::navigation
