// StereoOdometry: where the features of the keyframe are in the two images, and which of them to believe.
#include <algorithm>
#include <cmath>

#include "odometry/common/exact_clique.h"
#include "odometry/stereo/stereo_odometry.h"
#include "vision/image_shift.h"
#include "vision/pixel.h"

namespace stereo_nav::odometry {

Eigen::Vector2d StereoOdometry::predictedPixel(std::size_t i, const vision::StereoView& view) const {
  const Eigen::Vector3d p = view.T_camera_world * landmarks_[i].p_world();
  return p.z() < vision::kNearestDepth_m ? tracks_[i].last_px : vision::projectLeft(calibration_, p);
}

Eigen::Vector2d StereoOdometry::predictedInImage(std::size_t i, const vision::StereoView& view) const {
  const Eigen::Vector2d px = predictedPixel(i, view);
  if (shutter_.isGlobal()) return px;
  return shutter_.seenLeft(px, view.T_camera_world * landmarks_[i].p_world(), row_twist_);
}

Eigen::Matrix2f StereoOdometry::patchStep(std::size_t i, const vision::StereoView& view) const {
  // The keyframe is the last of the window as long as the current frame has no pose.
  const Eigen::Isometry3d T_keyframe_camera =
      window_.back().view.T_camera_world * view.T_camera_world.inverse();
  const Eigen::Vector3d p_world = landmarks_[i].p_world();
  const double zoom =
      (view.T_camera_world * p_world).z() / (window_.back().view.T_camera_world * p_world).z();
  if (!(zoom > 0.5 && zoom < 2.0)) return Eigen::Matrix2f::Identity();
  const Eigen::Matrix3d& R = T_keyframe_camera.linear();
  const double roll = std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1));
  return (zoom * Eigen::Rotation2Dd(roll).toRotationMatrix()).cast<float>();
}

bool StereoOdometry::trackOne(const Images& images, std::size_t i, const Eigen::Vector2d& guess_px,
                              int top_level, const Eigen::Matrix2f& step, int finest_level) {
  Track& track = tracks_[i];
  const auto match = tracker_.track(keyframe_image_, vision::toCv(track.keyframe_px), images.left,
                                    vision::toCv(guess_px), top_level, step, finest_level);
  track.found = match.has_value();
  if (!match) return false;
  track.in_image.left_px = vision::toEigen(match->px);
  track.in_image.noise = 1 << finest_level;
  return true;
}

void StereoOdometry::trackAll(const Images& images, const vision::StereoView& predicted,
                              bool moved_as_predicted) {
  const int coarsest = params_.pyramid_levels - 1;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Track& track = tracks_[i];
    if (track.inlier) {
      track.last_px = track.in_image.left_px;
      ++track.confirmations;
    }
    track.fresh = false;
    track.inlier = false;
    track.found = false;
    if (!track.alive) continue;
    if (moved_as_predicted && trackOne(images, i, predictedInImage(i, predicted), std::min(2, coarsest),
                                       patchStep(i, predicted), 0))
      continue;
    trackOne(images, i, track.last_px, coarsest, Eigen::Matrix2f::Identity(), 0);
  }
  if (lostMany()) trackAfterTurn(images);
  if (lostMany()) trackBlurred(images, predicted, moved_as_predicted);
  appointVoters();
}

bool StereoOdometry::lostMany() const {
  constexpr double kShare = 0.5;
  std::size_t alive = 0;
  std::size_t found = 0;
  for (const Track& track : tracks_) {
    if (track.alive) ++alive;
    if (track.found) ++found;
  }
  return static_cast<double>(found) < kShare * static_cast<double>(alive);
}

void StereoOdometry::trackAfterTurn(const Images& images) {
  const auto shift = vision::coarseShift(keyframe_image_, images.left);
  if (!shift) return;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!tracks_[i].alive || tracks_[i].found) continue;
    trackOne(images, i, tracks_[i].keyframe_px + vision::toEigen(*shift), params_.pyramid_levels - 1,
             Eigen::Matrix2f::Identity(), 0);
  }
}

void StereoOdometry::trackBlurred(const Images& images, const vision::StereoView& predicted,
                                  bool moved_as_predicted) {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!tracks_[i].alive || tracks_[i].found) continue;
    trackOne(images, i, moved_as_predicted ? predictedInImage(i, predicted) : tracks_[i].last_px,
             params_.pyramid_levels - 1, patchStep(i, predicted), 1);
  }
}

std::size_t StereoOdometry::recover(const Images& images, const vision::StereoView& view) {
  std::size_t recovered = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!tracks_[i].alive || tracks_[i].inlier) continue;
    if (!trackOne(images, i, predictedInImage(i, view), 1, patchStep(i, view), 0)) continue;
    matchStereoOne(images, i, view, 0.0);
    ++recovered;
  }
  appointVoters();
  return recovered;
}

void StereoOdometry::matchStereo(const Images& images, const vision::StereoView& view, double slack_px) {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].found) matchStereoOne(images, i, view, slack_px);
  }
}

void StereoOdometry::matchStereoOne(const Images& images, std::size_t i, const vision::StereoView& view,
                                    double slack_px) {
  Track& track = tracks_[i];
  track.in_image.has_right = false;
  // Seen from where the feature is, not from where the map expects it.
  const double depth_m = (view.T_camera_world * landmarks_[i].p_world()).z();
  if (depth_m < vision::kNearestDepth_m) return;
  const Eigen::Vector2d guess =
      vision::transferToRight(calibration_, view.T_late_camera, track.in_image.left_px, 1.0 / depth_m);
  const auto match =
      stereo_.refine(images.left, images.right, view.T_late_camera, track.in_image.left_px, guess, slack_px);
  if (!match) return;
  track.in_image.right_px = match->right_px;
  track.in_image.has_right = true;
}

std::vector<std::size_t> StereoOdometry::foundTracks() const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].found) found.push_back(i);
  }
  return found;
}

void StereoOdometry::appointVoters() {
  constexpr int kConfirmations = 3;
  const int enough = params_.min_inliers + params_.min_inliers / 2;
  int required = kConfirmations;
  const auto proven = [&required](const Track& track) {
    return track.found && track.confirmations >= required;
  };
  while (required > 0 && std::count_if(tracks_.begin(), tracks_.end(), proven) < enough) --required;
  for (Track& track : tracks_) track.votes = proven(track);
}

std::vector<std::size_t> StereoOdometry::cliqueCandidates(const std::vector<std::size_t>& found) const {
  std::vector<std::size_t> candidates;
  for (const std::size_t i : found) {
    if (tracks_[i].seen.has_right && tracks_[i].votes) candidates.push_back(i);
  }
  const auto most = static_cast<std::size_t>(params_.clique_points);
  const std::size_t all = candidates.size();
  if (all <= most) return candidates;
  // Old and young ones alike: tracks are in the order of their detection.
  for (std::size_t k = 0; k < most; ++k) candidates[k] = candidates[k * all / most];
  candidates.resize(most);
  return candidates;
}

std::vector<std::size_t> StereoOdometry::selectRigid(const vision::StereoView& view,
                                                     FrameResult& result) const {
  const std::vector<std::size_t> found = foundTracks();
  std::vector<std::size_t> with_depth;
  std::vector<RigidPoint> points;
  for (const std::size_t i : cliqueCandidates(found)) {
    const vision::StereoObservation& seen = tracks_[i].seen;
    const vision::Triangulation depth =
        vision::triangulate(calibration_, view.T_late_camera, seen.left_px, seen.right_px);
    if (depth.inverse_depth <= 0.0) continue;
    with_depth.push_back(i);
    points.push_back({last_view_.T_camera_world * landmarks_[i].p_world(),
                      vision::leftRay(calibration_, seen.left_px) / depth.inverse_depth});
  }
  const CliqueResult clique = largestClique(buildNoisyRigidityGraph(params_.rigidity, calibration_, points),
                                            static_cast<std::size_t>(params_.clique_budget));
  result.features_tracked = static_cast<std::uint32_t>(found.size());
  result.features_with_depth = static_cast<std::uint32_t>(with_depth.size());
  result.clique_size = static_cast<std::uint32_t>(clique.members.size());
  if (clique.members.size() < static_cast<std::size_t>(params_.min_inliers)) return found;
  std::vector<std::size_t> rigid;
  for (const std::size_t member : clique.members) rigid.push_back(with_depth[member]);
  return rigid;
}

void StereoOdometry::report(FrameResult& result) const {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    if (!track.found) continue;
    FeatureReport report;
    report.id = landmarks_[i].id;
    report.current_px = vision::toCv(track.in_image.left_px);
    report.previous_px = track.fresh ? report.current_px : vision::toCv(track.last_px);
    report.fate = track.fresh            ? FeatureReport::Fate::kDetected
                  : track.inlier         ? FeatureReport::Fate::kInlier
                  : track.seen.has_right ? FeatureReport::Fate::kRejected
                                         : FeatureReport::Fate::kNoDepth;
    report.p_camera = last_view_.T_camera_world * landmarks_[i].p_world();
    if (track.inlier && !track.fresh) ++result.inliers;
    result.features.push_back(report);
  }
}

}  // namespace stereo_nav::odometry
