#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::vision {

struct CornerDetectorParams {
  int rows = 2;
  int columns = 5;
  int per_bucket = 15;  ///< 15 * 2 * 5 gives the 150 features of the thesis' measurements
  int threshold = 20;

  void describe(ParameterVisitor& visitor);
};

/// FAST corners, evenly spread: the image is cut into rows x columns buckets and the strongest of each are
/// kept (thesis, step 1; FAST 9-16 with non-maximum suppression: Rosten and Drummond 2006).
class CornerDetector {
 public:
  explicit CornerDetector(const CornerDetectorParams& params);

  /// `image` is CV_8UC1. Positions in px, bucket by bucket in row order, strongest first within a bucket.
  std::vector<cv::Point2f> detect(const cv::Mat& image) const;

 private:
  CornerDetectorParams params_;
};

}  // namespace stereo_nav::vision
