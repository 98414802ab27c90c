#pragma once

#include <optional>

#include "stereo_nav/core/parameter_visitor.h"
#include "vision/image_pyramid.h"
#include "vision/patch.h"

namespace stereo_nav::vision {

struct PatchTrackerParams {
  int window_px = 11;
  int coarse_window_px = 15;
  int iterations = 10;
  double min_step_px = 0.02;
  double min_texture = 0.5;
  double min_correlation = 0.7;

  void describe(ParameterVisitor& visitor);
};

/// Finds the surroundings of a pixel again in another image, from coarse to fine.
class PatchTracker {
 public:
  explicit PatchTracker(const PatchTrackerParams& params) : params_(params) {}

  /// `guess` is where `px` of `from` is expected in `to`; `top_level` is the coarsest level of the search.
  /// `step` is how many px of `from` a px of `to` is expected to span, as an axis each. Coarse levels only
  /// move the guess; `finest_level` decides: 0, or more for images in which the fine detail is blurred.
  /// Finds nothing without enough texture or likeness.
  std::optional<Patch::Match> track(const ImagePyramid& from, const cv::Point2f& px, const ImagePyramid& to,
                                    const cv::Point2f& guess, int top_level,
                                    const Eigen::Matrix2f& step = Eigen::Matrix2f::Identity(),
                                    int finest_level = 0) const;

  const PatchTrackerParams& params() const { return params_; }

 private:
  PatchTrackerParams params_;
};

}  // namespace stereo_nav::vision
