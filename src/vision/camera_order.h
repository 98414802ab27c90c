#pragma once

#include <deque>
#include <opencv2/core.hpp>

#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::vision {

/// Notices that the left and right images were swapped, by their cables or device indices. A rectified pair
/// in the right order has no negative disparities. The disparity map does not show a swap, since it searches
/// positive disparities only and then finds chance matches. Therefore a few distinct corners of the left
/// image are searched now and then on both sides of their place in the right image, at reduced size and a few
/// rows up and down, since a swapped pair is rectified with the wrong lenses. The signs of their disparities
/// are counted. The rig need not move.
class CameraOrderCheck {
 public:
  enum class Verdict { kUnknown, kInOrder, kSwapped };

  explicit CameraOrderCheck(const StereoCalibration& calibration) : calibration_(calibration) {}

  /// Rectified pair, CV_8UC1, of the calibration's size. About 3 ms for 752x480; once a second is enough.
  void observe(const cv::Mat& left, const cv::Mat& right);
  void reset() { votes_.clear(); }

  /// From the last few observations. It is unknown until enough corners were found again, which takes texture
  /// nearer than about 100 baselines.
  Verdict verdict() const;

 private:
  struct Votes {
    int positive = 0;
    int negative = 0;
  };

  StereoCalibration calibration_;
  std::deque<Votes> votes_;
};

}  // namespace stereo_nav::vision
