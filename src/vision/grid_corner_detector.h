#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::vision {

struct GridCornerDetectorParams {
  int features = 200;
  int cells = 300;
  int initial_threshold = 20;
  int min_threshold = 5;
  double min_distance_px = 10.0;

  void describe(ParameterVisitor& visitor);
};

/// FAST corners where live tracks are missing: the image is cut into square cells, each with a threshold of
/// its own that follows the texture it sees from image to image.
class GridCornerDetector {
 public:
  GridCornerDetector(const GridCornerDetectorParams& params, const cv::Size& image_size);

  /// New corners of `image` (CV_8UC1), at most `params.features` minus those `occupied`, first one for every
  /// empty cell, the strongest cells first; none nearer than `min_distance_px` to another or to `occupied`.
  std::vector<cv::Point2f> detect(const cv::Mat& image, const std::vector<cv::Point2f>& occupied);

  void reset();

 private:
  struct Candidate {
    cv::Point2f px;
    float response;
    int rank;  ///< within its cell, counting the live tracks in it
  };
  cv::Rect cellRect(int cell) const;
  void detectCell(const cv::Mat& image, int cell, int occupied, std::vector<Candidate>& candidates);

  GridCornerDetectorParams params_;
  cv::Size image_size_;
  int cell_size_px_;
  int columns_;
  int rows_;
  std::vector<int> thresholds_;
};

}  // namespace stereo_nav::vision
