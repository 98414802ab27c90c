#pragma once

#include <vector>

#include "odometry/stereo/right_image_matcher.h"
#include "vision/grid_corner_detector.h"

namespace stereo_nav::odometry {

/// Places a landmark that was first seen at the pixels `seen` (which are brought to the stamps) by a rig in
/// the pose `view` that moves with `twist` (m/s, rad/s). Its anchor is the camera of `view`, and its inverse
/// depth is, until it is refined, that of the pixels.
void placeAtStamp(const vision::StereoCalibration& calibration, const vision::RollingShutter& shutter,
                  const vision::StereoView& view, const Vector6d& twist, Landmark& landmark,
                  vision::StereoObservation& seen);

/// Finds new landmarks where a keyframe has too few features.
class LandmarkDetector {
 public:
  LandmarkDetector(const vision::GridCornerDetectorParams& params,
                   const vision::StereoCalibration& calibration)
      : calibration_(calibration), detector_(params, cv::Size(calibration.width, calibration.height)) {}

  /// Corners that the left image has, whatever their depth.
  std::size_t countCorners(const vision::ImagePyramid& left);

  /// How a frame sees the world.
  struct Frame {
    const StereoImages& images;
    const vision::RollingShutter& shutter;
    vision::StereoView view;
    Vector6d twist;
    double slack_px;  ///< largest expected error of an epipolar line, px
  };
  struct Result {
    std::vector<NewLandmark> landmarks;
    std::size_t corners;  ///< those without a match in the right image included
  };
  /// Landmarks at new corners, away from the tracks that are alive.
  Result detect(const Frame& frame, const std::vector<Track>& tracks, const RightImageMatcher& matcher);

 private:
  vision::StereoCalibration calibration_;
  vision::GridCornerDetector detector_;
};

}  // namespace stereo_nav::odometry
