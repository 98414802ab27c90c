#pragma once

#include <opencv2/core.hpp>

namespace stereo_nav::grid {

/// A rectangle with `margin` cells more on each side, within the grid.
inline cv::Rect grown(const cv::Rect& rectangle, int margin, cv::Size grid) {
  const cv::Rect larger(rectangle.x - margin, rectangle.y - margin, rectangle.width + 2 * margin,
                        rectangle.height + 2 * margin);
  return larger & cv::Rect({0, 0}, grid);
}

}  // namespace stereo_nav::grid
