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

namespace {

/// Whether rows are learned from this track; its residual in `view`.
bool teaches(const vision::StereoCalibration& calibration, const vision::StereoView& view, const Track& track,
             vision::ViewResidual& residual) {
  return track.inlier && track.at_stamp.has_right && track.at_stamp.noise <= 1.0 &&
         vision::viewResidual(calibration, view, track.p_world, track.at_stamp, residual);
}

}  // namespace

void RightImageMatcher::learn(const vision::StereoView& view, const MotionPrior& prior,
                              const std::vector<Track>& tracks) {
  // First the stamps: what is subtracted from the rows still is that with which they were matched.
  learnStamps(view, prior, tracks);
  learnRows(view, tracks);
}

void RightImageMatcher::learnRows(const vision::StereoView& view, const std::vector<Track>& tracks) {
  vision::EpipolarError& rows = stereo_.epipolarError();
  vision::ViewResidual residual;
  for (const Track& track : tracks) {
    if (!teaches(calibration_, view, track, residual)) continue;
    const Eigen::Vector2d& px = track.in_image.right_px;
    rows.add(px, residual.error_px(3) - residual.error_px(1) + rows.at(px).y());
  }
  rows.learn();
}

void RightImageMatcher::learnStamps(const vision::StereoView& view, const MotionPrior& prior,
                                    const std::vector<Track>& tracks) {
  const Vector6d twist = prior.twistAt(view);
  const vision::EpipolarError& rows = stereo_.epipolarError();
  // The motion between the images by the stamps, not the one that the images themselves have told.
  const vision::StereoView by_stamps{view.T_camera_world, expMotion(twist * prior.right_time_offset_s)};
  vision::ViewResidual residual;
  for (const Track& track : tracks) {
    if (!teaches(calibration_, by_stamps, track, residual)) continue;
    const Eigen::Vector2d& px = track.in_image.right_px;
    stamp_error_.add(rows.basis(px), residual.error_px(3) - residual.error_px(1) + rows.at(px).y(),
                     residual.by_late.row(1).dot(twist));
  }
  stamp_error_.learn();
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
