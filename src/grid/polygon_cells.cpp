#include "grid/polygon_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stereo_nav::grid {
namespace {

constexpr double kTouch = 1e-6;  // of a cell

/// The first and the last cell of those that an interval reaches into.
int firstCell(double from) {
  return static_cast<int>(std::floor(from + kTouch));
}
int lastCell(double to) {
  return static_cast<int>(std::ceil(to - kTouch)) - 1;
}

struct Extent {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  void add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
};

/// Adds what of a polygon's side lies in the strip from `low` to `high`.
void addSide(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double low, double high, Extent& x) {
  const double y0 = std::max(low, std::min(a.y(), b.y())), y1 = std::min(high, std::max(a.y(), b.y()));
  if (y0 > y1) return;
  if (a.y() == b.y()) {
    x.add(a.x());
    x.add(b.x());
    return;
  }
  const double slope = (b.x() - a.x()) / (b.y() - a.y());
  x.add(a.x() + slope * (y0 - a.y()));
  x.add(a.x() + slope * (y1 - a.y()));
}

}  // namespace

std::vector<CellSpan> cellsOf(const Polygon& polygon_cells) {
  Extent y;
  for (const auto& corner : polygon_cells) y.add(corner.y());
  std::vector<CellSpan> spans;
  for (int row = firstCell(y.min); row <= lastCell(y.max); ++row) {
    Extent x;
    for (std::size_t i = 0; i < polygon_cells.size(); ++i)
      addSide(polygon_cells[i], polygon_cells[(i + 1) % polygon_cells.size()], row, row + 1.0, x);
    spans.push_back({row, firstCell(x.min), lastCell(x.max)});
  }
  return spans;
}

}  // namespace stereo_nav::grid
