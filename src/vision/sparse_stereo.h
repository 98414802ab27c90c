#pragma once

#include <optional>

#include "stereo_nav/core/parameter_visitor.h"
#include "vision/epipolar_error.h"
#include "vision/patch_tracker.h"
#include "vision/stereo_view.h"

namespace stereo_nav::vision {

struct SparseStereoParams {
  PatchTrackerParams refinement = defaultRefinement();
  EpipolarErrorParams epipolar_error;
  double max_disparity_share = 0.25;
  int search_window_px = 11;
  double search_correlation = 0.7;
  double uniqueness = 0.95;
  double max_epipolar_px = 1.5;
  double min_disparity_px = 0.1;

  void describe(ParameterVisitor& visitor);

  /// Patches smaller than for tracking: surfaces lean more between the two cameras than between two frames.
  static PatchTrackerParams defaultRefinement() {
    PatchTrackerParams refinement;
    refinement.window_px = 9;
    return refinement;
  }
};

/// A corner of the left image found in the right one.
struct StereoMatch {
  Eigen::Vector2d right_px;  ///< freed from the epipolar error known so far
  Triangulation depth;
};

/// Finds corners of the left image in the right one, to a fraction of a pixel and whatever the gain and
/// offset between the two cameras. The search line bends with the motion between the two stamps;
/// `slack_px` is how far off it may be because that motion is not known well, 0 for synchronous pairs. What
/// the calibration's rows are off is learned by epipolarError() from the matches that the caller believes.
class SparseStereoMatcher {
 public:
  SparseStereoMatcher(const SparseStereoParams& params, const StereoCalibration& calibration);

  /// Matches from a predicted position in the right image.
  std::optional<StereoMatch> refine(const ImagePyramid& left, const ImagePyramid& right,
                                    const Eigen::Isometry3d& T_late_camera, const Eigen::Vector2d& left_px,
                                    const Eigen::Vector2d& guess_px, double slack_px) const;

  /// Matches without a prediction: searches the whole range of disparities on a coarse level and refines the
  /// result. Finds nothing if a second place looks nearly as alike.
  std::optional<StereoMatch> search(const ImagePyramid& left, const ImagePyramid& right,
                                    const Eigen::Isometry3d& T_late_camera, const Eigen::Vector2d& left_px,
                                    double slack_px) const;

  EpipolarError& epipolarError() { return epipolar_error_; }
  const EpipolarError& epipolarError() const { return epipolar_error_; }

 private:
  Eigen::Vector2d withRowError(const Eigen::Vector2d& px) const { return px + epipolar_error_.at(px); }
  std::optional<StereoMatch> align(const ImagePyramid& left, const ImagePyramid& right,
                                   const Eigen::Isometry3d& T_late_camera, const Eigen::Vector2d& left_px,
                                   const Eigen::Vector2d& start_px, double slack_px) const;
  std::optional<StereoMatch> accept(const Eigen::Isometry3d& T_late_camera, const Eigen::Vector2d& left_px,
                                    const Eigen::Vector2d& right_px, double slack_px) const;

  SparseStereoParams params_;
  StereoCalibration calibration_;
  PatchTracker tracker_;
  EpipolarError epipolar_error_;
  int search_level_;
};

}  // namespace stereo_nav::vision
