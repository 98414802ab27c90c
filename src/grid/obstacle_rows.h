#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "grid/polygon_cells.h"

namespace stereo_nav::grid {

/// How many obstacles each row has up to each column, so that a question about any span of cells takes two
/// look-ups.
class ObstacleRows {
 public:
  /// `obstacles`: CV_8UC1, 0 or 1. `outside`: whether all beyond the edge counts as an obstacle.
  void assign(const cv::Mat_<std::uint8_t>& obstacles, bool outside);
  /// Follows a change within `changed`.
  void update(const cv::Mat_<std::uint8_t>& obstacles, const cv::Rect& changed);

  bool anyIn(const CellSpan& span) const;
  bool anyIn(const std::vector<CellSpan>& spans) const;

 private:
  int width_ = 0, height_ = 0;
  bool outside_ = true;
  cv::Mat_<std::int32_t> counts_;  ///< one column more than the grid
};

}  // namespace stereo_nav::grid
