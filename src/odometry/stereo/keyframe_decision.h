#pragma once

#include <vector>

#include "odometry/stereo/track.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::odometry {

struct KeyframeParams {
  int window = 12;
  double min_tracked_share = 0.6;
  double max_parallax_px = 40.0;

  void describe(ParameterVisitor& visitor);
};

/// Whether the current frame becomes a keyframe: too few inliers are left of the last keyframe's
/// `keyframe_features`, or in the next frame they would have moved too far, assuming the same motion.
bool needsKeyframe(const KeyframeParams& params, const std::vector<Track>& tracks,
                   std::size_t keyframe_features);

}  // namespace stereo_nav::odometry
