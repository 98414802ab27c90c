#include "grid/obstacle_rows.h"

#include <algorithm>

namespace stereo_nav::grid {

void ObstacleRows::assign(const cv::Mat_<std::uint8_t>& obstacles, bool outside) {
  width_ = obstacles.cols;
  height_ = obstacles.rows;
  outside_ = outside;
  counts_.create(height_, width_ + 1);
  update(obstacles, {0, 0, width_, height_});
}

void ObstacleRows::update(const cv::Mat_<std::uint8_t>& obstacles, const cv::Rect& changed) {
  for (int y = changed.y; y < changed.br().y; ++y) {
    const std::uint8_t* row = obstacles[y];
    std::int32_t* counts = counts_[y];
    std::int32_t sum = counts[0] = 0;
    for (int x = 0; x < width_; ++x) counts[x + 1] = sum += row[x];
  }
}

bool ObstacleRows::anyIn(const CellSpan& span) const {
  if (outside_ && (span.y < 0 || span.y >= height_ || span.left < 0 || span.right >= width_)) return true;
  if (span.y < 0 || span.y >= height_) return false;
  const int left = std::clamp(span.left, 0, width_), end = std::clamp(span.right + 1, left, width_);
  return counts_(span.y, end) > counts_(span.y, left);
}

bool ObstacleRows::anyIn(const std::vector<CellSpan>& spans) const {
  return std::any_of(spans.begin(), spans.end(), [this](const CellSpan& span) { return anyIn(span); });
}

}  // namespace stereo_nav::grid
