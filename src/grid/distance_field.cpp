#include "grid/distance_field.h"

#include <opencv2/imgproc.hpp>

#include "grid/rectangles.h"

namespace stereo_nav::grid {

void DistanceField::assign(const cv::Mat& obstacles) {
  cells_.create(obstacles.size());
  update(obstacles, {0, 0, obstacles.cols, obstacles.rows});
}

void DistanceField::update(const cv::Mat& obstacles, const cv::Rect& changed) {
  if (changed.empty()) return;
  const cv::Rect felt = grown(changed, reach_cells_, obstacles.size());
  const cv::Rect seen = grown(felt, reach_cells_, obstacles.size());
  cv::Mat distances;
  cv::distanceTransform(obstacles(seen) == 0, distances, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::Mat part = cells_(felt);
  cv::min(distances(felt - seen.tl()), static_cast<double>(reach_cells_), part);
}

}  // namespace stereo_nav::grid
