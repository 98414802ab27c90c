#include "odometry/laser/line_map.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::odometry {
namespace {

/// A line needs this many points.
constexpr double kLeastPointsOfLine = 4.0;
/// Largest ratio of the variances across and along a line; corners and clutter have more.
constexpr double kWidest = 0.2;
/// Levels that are tried where the finest one that suits holds no line.
constexpr int kCoarser = 1;
/// Cells as wide as this many standard deviations: three of them hold eight, which keeps the axis of the
/// points that of the wall.
constexpr double kCellSigmas = 2.7;
/// So many empty cells may stay.
constexpr std::size_t kLeastCells = 1000;

/// std::floor() is a call of a function on processors without SSE 4.1.
int indexOf(double value_m, double cell_m) {
  const double cells = value_m / cell_m;
  const int towards_zero = static_cast<int>(cells);
  return towards_zero - (cells < towards_zero ? 1 : 0);
}

}  // namespace

LineMap::LineMap(double cell_m, int keyframes)
    : cell_m_(cell_m), most_keyframes_(static_cast<std::size_t>(keyframes)) {}

void LineMap::clear() {
  for (Grid& grid : grids_) grid.clear();
  scans_.clear();
  ++changes_;
}

void LineMap::add(const std::vector<Eigen::Vector2d>& points_map) {
  if (scans_.size() == most_keyframes_) {
    change(scans_.front(), -1.0);
    scans_.pop_front();
  }
  for (int level = 0; level < kLevels; ++level) forgetEmptyCells(level);
  change(points_map, 1.0);
  scans_.push_back(points_map);
}

/// Scans that leave the map and look-ups in the open leave empty cells behind.
void LineMap::forgetEmptyCells(int level) {
  Grid& grid = grids_[static_cast<std::size_t>(level)];
  std::size_t& forget_at = forget_at_[static_cast<std::size_t>(level)];
  if (grid.cells() < forget_at) return;
  grid.forget([](const Cell& cell) { return cell.n < 0.5; });
  forget_at = 2 * grid.cells() + kLeastCells;
}

std::size_t LineMap::cells() const {
  std::size_t sum = 0;
  for (const Grid& grid : grids_) sum += grid.cells();
  return sum;
}

void LineMap::change(const std::vector<Eigen::Vector2d>& points_map, double sign) {
  ++changes_;
  for (const Eigen::Vector2d& p_map : points_map)
    for (int level = 0; level < kLevels; ++level) addTo(level, p_map, sign);
}

void LineMap::addTo(int level, const Eigen::Vector2d& p_map, double sign) {
  Grid& grid = grids_[static_cast<std::size_t>(level)];
  const double size_m = cell_m(level);
  const int ix = indexOf(p_map.x(), size_m), iy = indexOf(p_map.y(), size_m);
  Cell& cell = grid.at(ix, iy);
  const double x = p_map.x() - (ix + 0.5) * size_m, y = p_map.y() - (iy + 0.5) * size_m;
  cell.n += sign;
  cell.x += sign * x;
  cell.y += sign * y;
  cell.xx += sign * x * x;
  cell.xy += sign * x * y;
  cell.yy += sign * y * y;
  if (cell.n < 0.5) cell.x = cell.y = cell.xx = cell.xy = cell.yy = 0.0;  // without rounding errors
  if (cell.last_change == changes_) return;
  cell.last_change = changes_;
  cell.keyframes += sign > 0.0 ? 1 : -1;
  if (cell.n < 0.5) cell = Cell();
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      if (Cell* neighbour = grid.find(ix + dx, iy + dy)) neighbour->fitted = false;
    }
  }
}

std::optional<MapLine> LineMap::fit(int level, int ix, int iy) const {
  Grid& grid = grids_[static_cast<std::size_t>(level)];
  const double size_m = cell_m(level);
  Cell sum;
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      const Cell* found = grid.find(ix + dx, iy + dy);
      if (found == nullptr) continue;
      const Cell& cell = *found;
      const double ox = dx * size_m, oy = dy * size_m;
      sum.n += cell.n;
      sum.x += cell.x + cell.n * ox;
      sum.y += cell.y + cell.n * oy;
      sum.xx += cell.xx + 2.0 * ox * cell.x + cell.n * ox * ox;
      sum.xy += cell.xy + ox * cell.y + oy * cell.x + cell.n * ox * oy;
      sum.yy += cell.yy + 2.0 * oy * cell.y + cell.n * oy * oy;
      sum.keyframes = std::max(sum.keyframes, cell.keyframes);
    }
  }
  if (sum.n < kLeastPointsOfLine) return std::nullopt;
  const double mx = sum.x / sum.n, my = sum.y / sum.n;
  const double cxx = sum.xx / sum.n - mx * mx, cxy = sum.xy / sum.n - mx * my, cyy = sum.yy / sum.n - my * my;
  const double mean = 0.5 * (cxx + cyy), spread = std::hypot(0.5 * (cxx - cyy), cxy);
  const double along = mean + spread, across = std::max(mean - spread, 0.0);
  constexpr double kShortest = 0.25;  // of a cell
  if (across > kWidest * along || along < std::pow(kShortest * size_m, 2)) return std::nullopt;
  const double angle_rad = 0.5 * std::atan2(2.0 * cxy, cxx - cyy);
  MapLine line;
  line.centre << (ix + 0.5) * size_m + mx, (iy + 0.5) * size_m + my;
  line.normal << -std::sin(angle_rad), std::cos(angle_rad);
  line.across_m2 = across;
  line.centre_variance_m2 = across / sum.n;
  line.normal_variance_rad2 = across / (along * sum.n);
  line.half_length_m = std::sqrt(along);
  line.keyframes = sum.keyframes;
  return line;
}

int LineMap::levelFor(double sigma_m) const {
  int level = 0;
  while (level + 1 < kLevels && cell_m(level) < kCellSigmas * sigma_m) ++level;
  return level;
}

const MapLine* LineMap::lineAt(const Eigen::Vector2d& p_map, int level) const {
  const int coarsest = std::min(level + kCoarser, kLevels - 1);
  for (; level <= coarsest; ++level) {
    const double size_m = cell_m(level);
    const int ix = indexOf(p_map.x(), size_m), iy = indexOf(p_map.y(), size_m);
    Cell& cell = grids_[static_cast<std::size_t>(level)].at(ix, iy);
    if (!cell.fitted) {
      cell.line = fit(level, ix, iy);
      cell.fitted = true;
    }
    if (cell.line) return &*cell.line;
  }
  return nullptr;
}

}  // namespace stereo_nav::odometry
