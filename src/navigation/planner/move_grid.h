#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "grid/grid_geometry.h"

namespace stereo_nav::navigation {

/// The eight moves to neighbouring cells, counterclockwise from +x; odd ones are diagonal.
constexpr int kMoves = 8;
constexpr std::array<grid::Cell, kMoves> kMoveSteps{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// What a search needs to know of a map: which moves each cell allows, and what they cost. Rows of `width`
/// cells each; bit k of a byte stands for move k.
struct MoveGrid {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> moves;
  /// Bit k: at this cell the robot may turn between the directions of moves k and k + 1. Empty: it may turn
  /// anywhere.
  std::vector<std::uint8_t> turns;
  /// Extra cost of entering a cell by move k, in units of 1 / kCostUnits of the move's length. Null: length
  /// alone counts, and then the moves must be those of movesOfPoint().
  std::array<const std::uint8_t*, kMoves> costs{};
  static constexpr std::uint32_t kCostUnits = 32;

  std::size_t index(grid::Cell cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(cell.x);
  }
};

/// The moves of a point between the centres of free cells. A diagonal move needs both cells beside it free,
/// so that no corner is cut: the rule of the public grid benchmark (Sturtevant 2012, "Benchmarks for
/// grid-based pathfinding"). `obstacles`: CV_8UC1, zero where free.
MoveGrid movesOfPoint(const cv::Mat& obstacles);

}  // namespace stereo_nav::navigation
