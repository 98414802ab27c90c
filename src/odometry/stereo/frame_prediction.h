#pragma once

#include "odometry/stereo/track.h"

namespace stereo_nav::odometry {

/// Where the features of the keyframe are expected in the left image of the current frame. Refers to
/// `calibration` and `shutter`, which must outlive it.
class FramePrediction {
 public:
  /// `view` is the expected pose of the frame, `twist` that of the world in the camera frame (m/s, rad/s).
  FramePrediction(const vision::StereoCalibration& calibration, const vision::RollingShutter& shutter,
                  const vision::StereoView& view, const Vector6d& twist,
                  const Eigen::Isometry3d& T_keyframe_world)
      : calibration_(calibration),
        shutter_(shutter),
        view_(view),
        twist_(twist),
        T_keyframe_world_(T_keyframe_world) {}

  /// Pixel of the image, whose rows were taken one after another.
  Eigen::Vector2d leftPixel(const Track& track) const;
  /// How the patch of the keyframe is scaled and rolled: px of the keyframe's image per px of the current
  /// one.
  Eigen::Matrix2f patchStep(const Track& track) const;

 private:
  const vision::StereoCalibration& calibration_;
  const vision::RollingShutter& shutter_;
  vision::StereoView view_;
  Vector6d twist_;
  Eigen::Isometry3d T_keyframe_world_;
};

}  // namespace stereo_nav::odometry
