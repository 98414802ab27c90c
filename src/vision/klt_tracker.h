#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::vision {

struct KltParams {
  int window = 21;
  int levels = 3;
  int iterations = 30;
  double epsilon_px = 0.01;
  double min_eigenvalue = 1e-4;

  void describe(ParameterVisitor& visitor);
};

/// Pyramidal Lucas-Kanade (Bouguet 2000) on whole images (thesis, step 3).
class KltTracker {
 public:
  explicit KltTracker(const KltParams& params);

  struct Track {
    cv::Point2f position;  ///< px in the current image; meaningless unless `found`
    bool found = false;
  };

  /// One track per point, in order. A track that leaves the image is not found. Images are CV_8UC1 of one
  /// size.
  std::vector<Track> track(const cv::Mat& previous, const cv::Mat& current,
                           const std::vector<cv::Point2f>& previous_points) const;

 private:
  KltParams params_;
};

}  // namespace stereo_nav::vision
