#include "odometry/stereo/keyframe_decision.h"

#include "core/statistics.h"

namespace stereo_nav::odometry {

void KeyframeParams::describe(ParameterVisitor& visitor) {
  visitor.integer("window", window, {2, 50}, "", "keyframes refined together");
  visitor.real("min_tracked_share", min_tracked_share, {0.0, 1.0}, "",
               "a frame with a smaller share of the last keyframe's inliers becomes a keyframe");
  visitor.real(
      "max_parallax_px", max_parallax_px, {0.1, 1000.0}, "px",
      "largest median motion of the features from one keyframe to the next; a frame becomes a keyframe "
      "if the next frame would exceed it, assuming the same motion");
}

bool needsKeyframe(const KeyframeParams& params, const std::vector<Track>& tracks,
                   std::size_t keyframe_features) {
  std::vector<double> parallax_px;  // of the next frame, assuming the same motion
  for (const Track& track : tracks) {
    if (!track.inlier) continue;
    parallax_px.push_back((track.in_image.left_px - track.keyframe_px).norm() +
                          (track.in_image.left_px - track.previous_px).norm());
  }
  if (parallax_px.empty() || static_cast<double>(parallax_px.size()) <
                                 params.min_tracked_share * static_cast<double>(keyframe_features))
    return true;
  return upperMedian(parallax_px) > params.max_parallax_px;
}

}  // namespace stereo_nav::odometry
