#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "navigation/obstacles/floor_plane.h"
#include "navigation/obstacles/obstacle_params.h"

namespace stereo_nav::navigation {

/// What a few neighbouring columns of a disparity image show of the ground, all in z of the camera, m.
struct ColumnView {
  double u = 0.0;  ///< middle of the columns, px
  double clear_from_m =
      0.0;  ///< what is nearer is not seen: below the image, or nearer than the largest disparity
  double clear_to_m = 0.0;          ///< nothing stands before this; not above clear_from_m: nothing is known
  std::vector<double> obstacles_m;  ///< surfaces that stand on the floor, from near to far
  std::vector<double> holes_m;      ///< places of the floor that lie too deep
};

/// Finds what stands on the floor and where it falls away, column by column (stixels; Badino, Franke,
/// Pfeiffer 2009, simplified). The pixels of a column that are higher than the floor by more than their noise
/// are sorted by disparity; where enough of them agree, something stands there, at their mean. A piece of a
/// column that is deeper than the floor by more than its noise is a hole if the floor goes on behind it; if
/// something stands there instead, the floor mirrors it.
class StereoColumns {
 public:
  explicit StereoColumns(const ObstacleParams& params) : params_(params) {}

  /// `disparity`: CV_32FC1, px, at most 0 where unknown. The result is valid until the next call.
  const std::vector<ColumnView>& look(const cv::Mat& disparity, const DisparityCamera& camera);
  const FloorPlane& floor() const { return floor_; }

 private:
  void lookAt(const cv::Mat& disparity, const DisparityCamera& camera, int first, int last, ColumnView& view);
  void findObstacles(const DisparityCamera& camera, int columns, ColumnView& view);
  void findHoles(const cv::Mat& disparity, const DisparityCamera& camera, int column, ColumnView& view) const;

  ObstacleParams params_;
  FloorPlane floor_;
  std::vector<ColumnView> views_;
  std::vector<int> counts_;   ///< of pixels that stand, by disparity
  std::vector<double> sums_;  ///< of their disparities
};

}  // namespace stereo_nav::navigation
