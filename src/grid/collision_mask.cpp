#include "grid/collision_mask.h"

#include <algorithm>
#include <utility>

#include "grid/rectangles.h"

namespace stereo_nav::grid {

CollisionMask::CollisionMask(std::vector<CellSpan> shape, bool outside_is_obstacle)
    : shape_(std::move(shape)), outside_is_obstacle_(outside_is_obstacle) {
  for (const CellSpan& span : shape_) {
    min_x_ = std::min(min_x_, span.left);
    max_x_ = std::max(max_x_, span.right);
  }
}

void CollisionMask::assign(const cv::Mat_<std::uint8_t>& obstacles) {
  cells_.create(obstacles.size());
  begins_.create(obstacles.rows, obstacles.cols + 1);
  update(obstacles, {0, 0, obstacles.cols, obstacles.rows});
}

cv::Rect CollisionMask::affectedBy(const cv::Rect& changed) const {
  const cv::Point least(changed.x - max_x_, changed.y - shape_.back().y);
  const cv::Point end(changed.br().x - min_x_, changed.br().y - shape_.front().y);
  return cv::Rect(least, end) & cv::Rect({0, 0}, cells_.size());
}

cv::Rect CollisionMask::update(const cv::Mat_<std::uint8_t>& obstacles, const cv::Rect& changed) {
  const cv::Rect part = affectedBy(changed);
  if (part.empty()) return part;
  begins_(cv::Rect(part.x, part.y, part.width + 1, part.height)).setTo(0);
  // All obstacles that reach into this part count, not only those that changed.
  const int y0 = std::max(0, part.y + shape_.front().y),
            y1 = std::min(obstacles.rows, part.br().y + shape_.back().y);
  const int x0 = std::max(0, part.x + min_x_), x1 = std::min(obstacles.cols, part.br().x + max_x_);
  for (int y = y0; y < y1; ++y) {
    const std::uint8_t* row = obstacles[y];
    for (int x = x0; x < x1;) {
      if (row[x] == 0) {
        ++x;
        continue;
      }
      const int left = x;
      while (x < x1 && row[x] != 0) ++x;
      markRun(y, left, x - 1, part);
    }
  }
  for (int y = part.y; y < part.br().y; ++y) {
    std::int32_t reaching = 0;
    for (int x = part.x; x < part.br().x; ++x) cells_(y, x) = (reaching += begins_(y, x)) > 0 ? 1 : 0;
  }
  if (outside_is_obstacle_) markEdge(part);
  return part;
}

/// The shape at row v covers row v + span.y: obstacles there keep it from the columns where its span would
/// meet them.
void CollisionMask::markRun(int y, int left, int right, const cv::Rect& part) {
  for (const CellSpan& span : shape_) {
    const int v = y - span.y;
    if (v < part.y || v >= part.br().y) continue;
    const int from = std::max(part.x, left - span.right), end = std::min(part.br().x, right - span.left + 1);
    if (from >= end) continue;
    ++begins_(v, from);
    --begins_(v, end);
  }
}

void CollisionMask::markEdge(const cv::Rect& part) {
  const cv::Rect inside(cv::Point(-min_x_, -shape_.front().y),
                        cv::Point(cells_.cols - max_x_, cells_.rows - shape_.back().y));
  for (int y = part.y; y < part.br().y; ++y)
    for (int x = part.x; x < part.br().x; ++x)
      if (!inside.contains({x, y})) cells_(y, x) = 1;
}

}  // namespace stereo_nav::grid
