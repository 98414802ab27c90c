#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "odometry/laser/line_map.h"

namespace stereo_nav::odometry {

/// The points of a map around a place, on two rasters of the same cells. Fine: 2 in a cell with a point, 1 in
/// those beside. Coarse: the most that the fine one holds within a cell's distance.
class SearchRaster {
 public:
  static constexpr double kCell_m = 0.1;
  static constexpr double kReach_m = 15.0;  ///< from the middle, of points that are looked up
  static constexpr int kMostShift = 12;     ///< cells by which these may be shifted along each axis

  /// Draws the map around `middle`, unless that has been done already.
  void draw(const LineMap& map, const Eigen::Vector2d& middle);

  /// The place in the rasters of a point within reach, and what a shift by cells adds to it.
  int placeOf(const Eigen::Vector2d& p) const { return index(p.y(), 1) * kSide + index(p.x(), 0); }
  static constexpr int placesOfShift(int ix, int iy) { return iy * kSide + ix; }

  const std::vector<std::uint8_t>& fine() const { return fine_; }
  const std::vector<std::uint8_t>& coarse() const { return coarse_; }

 private:
  static constexpr int kDrawn = 321;  ///< cells that the map is drawn in, along each axis
  static constexpr int kMargin = 4;   ///< and empty ones around, in which shifted points may lie
  static constexpr int kSide = kDrawn + 2 * kMargin;

  /// For values that are not more than the margin before the first cell.
  int index(double value_m, int axis) const {
    return static_cast<int>((value_m - origin_(axis)) / kCell_m) + kMargin;
  }
  void mark(const Eigen::Vector2d& p);

  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero(), origin_ = Eigen::Vector2d::Zero();
  std::optional<std::uint64_t> version_;  ///< of the map that is drawn
  std::vector<std::uint8_t> fine_, coarse_;
};

}  // namespace stereo_nav::odometry
