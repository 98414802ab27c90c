#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace stereo_nav::vision {

/// An image and its halvings, built once per image and shared by all uses. A pixel (x, y) of level 0 lies at
/// (x, y) / 2^l of level l (5x5 Gaussian, Burt and Adelson 1983, as cv::pyrDown).
class ImagePyramid {
 public:
  /// Mirrored px that can be read around every level, for patches that hang over the edge.
  static constexpr int kBorder_px = 32;

  ImagePyramid() = default;

  /// Copies `image` (CV_8UC1). Levels that would be narrower or lower than 24 px are left out.
  ImagePyramid(const cv::Mat& image, int levels);

  bool empty() const { return levels_.empty(); }
  int levels() const { return static_cast<int>(levels_.size()); }
  const cv::Mat& level(int l) const { return levels_[static_cast<std::size_t>(l)]; }

 private:
  std::vector<cv::Mat> levels_;
};

}  // namespace stereo_nav::vision
