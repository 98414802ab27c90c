#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace stereo_nav::grid {

/// Distance of each cell's centre from the centre of the nearest obstacle, in cells, up to a reach beyond
/// which it does not matter. Exact (Felzenszwalb and Huttenlocher 2012, as OpenCV has it), and after a change
/// computed anew only where the change can be felt: within the reach around it.
class DistanceField {
 public:
  /// `reach_cells`: the largest value that cells have.
  explicit DistanceField(int reach_cells) : reach_cells_(reach_cells) {}

  /// Computes all. `obstacles`: CV_8UC1, zero where free.
  void assign(const cv::Mat& obstacles);
  /// Follows a change within `changed`, a part of the grid; `obstacles` is the whole grid. The result is that
  /// of assign().
  void update(const cv::Mat& obstacles, const cv::Rect& changed);

  /// CV_32FC1, as large as the grid.
  const cv::Mat_<float>& cells() const { return cells_; }

 private:
  int reach_cells_;
  cv::Mat_<float> cells_;
};

}  // namespace stereo_nav::grid
