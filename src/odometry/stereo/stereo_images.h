#pragma once

#include <cmath>

#include "stereo_nav/odometry/common/odometry.h"
#include "vision/image_pyramid.h"

namespace stereo_nav::odometry {

/// When the two images of a frame were taken, seconds.
struct FrameTimes {
  double left_s = 0.0;
  double right_s = 0.0;

  FrameTimes() = default;
  /// An offset that no vehicle moves noticeably in counts as none.
  FrameTimes(double left_time_s, double right_time_s) : left_s(left_time_s), right_s(right_time_s) {
    constexpr double kNegligibleOffset_s = 1e-5;
    if (std::abs(rightOffset_s()) < kNegligibleOffset_s) right_s = left_s;
  }

  /// How much later the right image was taken than the left one; negative if it was earlier.
  double rightOffset_s() const { return right_s - left_s; }
};

/// The two images of a frame, with their times.
struct StereoImages {
  /// `right_stamp_error_s` is taken off the right image's time.
  StereoImages(const StereoFrame& frame, int pyramid_levels, double right_stamp_error_s = 0.0)
      : left(frame.left, pyramid_levels),
        right(frame.right, pyramid_levels),
        times(frame.left_time_s, frame.right_time_s - right_stamp_error_s) {}

  vision::ImagePyramid left;
  vision::ImagePyramid right;
  FrameTimes times;
};

}  // namespace stereo_nav::odometry
