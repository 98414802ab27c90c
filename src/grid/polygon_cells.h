#pragma once

#include <vector>

#include "grid/footprint.h"

namespace stereo_nav::grid {

/// Neighbouring cells of one row, from column `left` to column `right`, both included.
struct CellSpan {
  int y = 0;
  int left = 0;
  int right = 0;

  bool operator==(const CellSpan& other) const {
    return y == other.y && left == other.left && right == other.right;
  }
};

/// All cells that a convex polygon reaches into, one span a row, from low to high. The polygon is in cells:
/// cell (x, y) is the square from (x, y) to (x + 1, y + 1). Sides that only touch do not count.
std::vector<CellSpan> cellsOf(const Polygon& polygon_cells);

}  // namespace stereo_nav::grid
