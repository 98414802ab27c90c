#pragma once

#include <optional>
#include <vector>

#include "odometry/stereo/right_stamp_error.h"
#include "odometry/stereo/stereo_images.h"
#include "odometry/stereo/track.h"
#include "odometry/stereo/window_optimizer.h"
#include "vision/sparse_stereo.h"

namespace stereo_nav::odometry {

/// A corner that was found in both images of a frame, which make it a point.
struct NewLandmark {
  Landmark landmark;                   ///< without id and observations
  vision::StereoObservation in_image;  ///< pixels of the images
  vision::StereoObservation at_stamp;  ///< the same as a global shutter would have seen them
};

/// Finds the tracks of the left image in the right one, and learns from them by how much the rows of the
/// right image are displaced against its calibration.
class RightImageMatcher {
 public:
  RightImageMatcher(const vision::SparseStereoParams& params, const vision::StereoCalibration& calibration)
      : calibration_(calibration), stereo_(params, calibration) {}

  /// Returns the largest expected error of an epipolar line, px, for this uncertainty of T_late_camera (m,
  /// rad).
  double slack_px(const Vector6d& late_sigma) const;

  /// Looks for the tracks that were found in the left image. Depths and the motion between the two stamps
  /// come from `view`.
  void match(const StereoImages& images, const vision::StereoView& view, double slack_px,
             std::vector<Track>& tracks) const;
  void match(const StereoImages& images, const vision::StereoView& view, double slack_px, Track& track) const;
  /// Looks for a corner of unknown depth.
  std::optional<vision::StereoMatch> search(const StereoImages& images, const vision::StereoView& view,
                                            const Eigen::Vector2d& left_px, double slack_px) const {
    return stereo_.search(images.left, images.right, view.T_late_camera, left_px, slack_px);
  }

  /// Learns the displacement of the rows from the inliers of a frame with this refined pose, and what is
  /// constantly wrong with the right stamps.
  void learn(const vision::StereoView& view, const MotionPrior& prior, const std::vector<Track>& tracks);
  /// The rows alone from the matches of a first frame whose two images have one stamp; these matches are
  /// corrected by what was learned.
  void learnRowsAtStart(std::vector<NewLandmark>& matches);

  const RightStampError& stampError() const { return stamp_error_; }

 private:
  void learnRows(const vision::StereoView& view, const std::vector<Track>& tracks);
  void learnStamps(const vision::StereoView& view, const MotionPrior& prior,
                   const std::vector<Track>& tracks);

  vision::StereoCalibration calibration_;
  vision::SparseStereoMatcher stereo_;
  RightStampError stamp_error_;
};

}  // namespace stereo_nav::odometry
