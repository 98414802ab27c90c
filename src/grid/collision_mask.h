#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "grid/polygon_cells.h"

namespace stereo_nav::grid {

/// Where a shape must not be: the cells at whose centre it would reach into an obstacle (its configuration
/// space obstacles, the Minkowski sum of the obstacles and the mirrored shape; Lozano-Perez 1983). The shape
/// is given by the spans of cells that it covers when it stands at the centre of cell (0, 0).
class CollisionMask {
 public:
  CollisionMask(std::vector<CellSpan> shape, bool outside_is_obstacle);

  /// `obstacles`: CV_8UC1, 0 or 1.
  void assign(const cv::Mat_<std::uint8_t>& obstacles);
  /// Follows a change within `changed`, and returns the part of the mask that may have changed. The result is
  /// that of assign().
  cv::Rect update(const cv::Mat_<std::uint8_t>& obstacles, const cv::Rect& changed);

  /// CV_8UC1, 1 where the shape collides.
  const cv::Mat_<std::uint8_t>& cells() const { return cells_; }
  const std::vector<CellSpan>& shape() const { return shape_; }

 private:
  cv::Rect affectedBy(const cv::Rect& changed) const;
  void markRun(int y, int left, int right, const cv::Rect& part);
  void markEdge(const cv::Rect& part);

  std::vector<CellSpan> shape_;
  bool outside_is_obstacle_;
  int min_x_ = 0, max_x_ = 0;
  cv::Mat_<std::uint8_t> cells_;
  cv::Mat_<std::int32_t>
      begins_;  ///< obstacles whose reach begins at a cell, less those whose reach has ended
};

}  // namespace stereo_nav::grid
