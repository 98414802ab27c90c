#pragma once

#include <opencv2/core.hpp>

namespace stereo_nav::vision {

/// How a camera fills 16-bit grey values. Cameras of 10, 12 or 14 bits leave the upper bits empty, and
/// programs that ignore the byte order store the two bytes the other way round.
struct BitDepth {
  int bits = 16;         ///< 8, 10, 12, 14 or 16, counted from the lowest bit
  bool swapped = false;  ///< the bytes of each value are exchanged

  bool isPlain() const { return bits == 16 && !swapped; }
};

/// Finds the depth from images of a recording. All of them must be of one camera model.
class BitDepthFinder {
 public:
  /// Images of other types than CV_16UC1 are ignored.
  void add(const cv::Mat& image);

  /// False before the first 16-bit image.
  bool hasImages() const { return has_images_; }
  /// Largest value seen, bytes in the right order.
  int largest() const;
  BitDepth depth() const;

 private:
  bool swapped() const;

  bool has_images_ = false;
  int largest_ = 0;
  int largest_swapped_ = 0;
  double roughness_ = 0.0;  ///< sum of the differences of neighbours
  double roughness_swapped_ = 0.0;
};

/// The same CV_16UC1 image with its bytes in order and its values over all 16 bits; values beyond the depth
/// become the largest one.
cv::Mat toFullRange(const cv::Mat& image, const BitDepth& depth);

}  // namespace stereo_nav::vision
