#pragma once

#include <deque>
#include <opencv2/core.hpp>

#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::vision {

/// Notices that the left and right images were swapped (cables, device indices). A rectified pair in the
/// right order has no negative disparity; the disparity map cannot tell, since it searches positive ones only
/// and then finds chance matches. So now and then a few distinct corners of the left image are looked for on
/// both sides of their row in the right image, at reduced size, a few rows up and down (a swapped pair is
/// rectified with the wrong lenses), and the signs are counted. Motion is not needed.
class CameraOrderCheck {
 public:
  enum class Verdict { kUnknown, kInOrder, kSwapped };

  explicit CameraOrderCheck(const StereoCalibration& calibration) : calibration_(calibration) {}

  /// Rectified pair, CV_8UC1, of the calibration's size. About 3 ms for 752x480; once a second is enough.
  void observe(const cv::Mat& left, const cv::Mat& right);
  void reset() { votes_.clear(); }

  /// The verdict from the last few observations; unknown until enough corners were found again (texture,
  /// depth below about 100 baselines).
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
