#include "odometry/stereo/right_image_matcher.h"

namespace stereo_nav::odometry {

double RightImageMatcher::slack_px(const Vector6d& late_sigma) const {
  constexpr double kNearDepth_m = 3.0;
  return calibration_.fx * (late_sigma.tail<3>().maxCoeff() + late_sigma.head<3>().maxCoeff() / kNearDepth_m);
}

void RightImageMatcher::match(const StereoImages& images, const vision::StereoView& view, double slack_px,
                              std::vector<Track>& tracks) const {
  for (Track& track : tracks) {
    if (track.found) match(images, view, slack_px, track);
  }
}

void RightImageMatcher::match(const StereoImages& images, const vision::StereoView& view, double slack_px,
                              Track& track) const {
  track.in_image.has_right = false;
  const double depth_m = (view.T_camera_world * track.p_world).z();
  if (depth_m < vision::kNearestDepth_m) return;
  // The search begins from the pixel where the feature is, not from where the map expects it.
  const Eigen::Vector2d guess_px =
      vision::transferToRight(calibration_, view.T_late_camera, track.in_image.left_px, 1.0 / depth_m);
  const auto match = stereo_.refine(images.left, images.right, view.T_late_camera, track.in_image.left_px,
                                    guess_px, slack_px);
  if (!match) return;
  track.in_image.right_px = match->right_px;
  track.in_image.has_right = true;
}

void RightImageMatcher::learnRows(const vision::StereoView& view, const std::vector<Track>& tracks) {
  vision::EpipolarError& rows = stereo_.epipolarError();
  for (const Track& track : tracks) {
    const vision::StereoObservation& seen = track.at_stamp;
    vision::ViewResidual residual;
    if (!track.inlier || !seen.has_right || seen.noise > 1.0 ||
        !vision::viewResidual(calibration_, view, track.p_world, seen, residual))
      continue;
    const Eigen::Vector2d& px = track.in_image.right_px;
    rows.add(px, residual.error_px(3) - residual.error_px(1) + rows.at(px).y());
  }
  rows.learn();
}

void RightImageMatcher::learnRowsAtStart(std::vector<NewLandmark>& matches) {
  vision::EpipolarError& rows = stereo_.epipolarError();
  const vision::EpipolarError before = rows;
  for (const NewLandmark& match : matches) {
    const vision::StereoObservation& seen = match.at_stamp;
    rows.add(seen.right_px, seen.right_px.y() - seen.left_px.y() + before.at(seen.right_px).y());
  }
  rows.learn();
  for (NewLandmark& match : matches) {
    Eigen::Vector2d& right_px = match.at_stamp.right_px;
    right_px -= rows.at(right_px) - before.at(right_px);
  }
}

}  // namespace stereo_nav::odometry
