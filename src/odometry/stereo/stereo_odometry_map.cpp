// StereoOdometry: keyframes and landmarks, and what they teach about the calibration.
#include <algorithm>
#include <cmath>

#include "odometry/stereo/stereo_odometry.h"
#include "vision/pixel.h"

namespace stereo_nav::odometry {

void StereoOdometry::refineWindow() {
  const int current = static_cast<int>(window_.size()) - 1;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].inlier) landmarks_[i].views.push_back({current, tracks_[i].seen});
  }
  optimizer_.optimise(window_, landmarks_);
}

void StereoOdometry::learnEpipolarError() {
  const vision::StereoView& view = window_.back().view;
  vision::EpipolarError& rows = stereo_.epipolarError();
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const vision::StereoObservation& seen = tracks_[i].seen;
    vision::ViewResidual residual;
    if (!tracks_[i].inlier || !seen.has_right || seen.noise > 1.0 ||
        !vision::viewResidual(calibration_, view, landmarks_[i].p_world(), seen, residual))
      continue;
    const Eigen::Vector2d& px = tracks_[i].in_image.right_px;
    rows.add(px, residual.error_px(3) - residual.error_px(1) + rows.at(px).y());
  }
  rows.learn();
}

void StereoOdometry::learnEpipolarErrorAtStart() {
  if (window_.back().skewed) return;  // the motion between the stamps is not known yet
  vision::EpipolarError& rows = stereo_.epipolarError();
  const vision::EpipolarError before = rows;
  for (const Track& track : tracks_) {
    rows.add(track.seen.right_px,
             track.seen.right_px.y() - track.seen.left_px.y() + before.at(track.seen.right_px).y());
  }
  rows.learn();
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Eigen::Vector2d& right_px = tracks_[i].seen.right_px;
    right_px -= rows.at(right_px) - before.at(right_px);
    landmarks_[i].views.back().seen.right_px = right_px;
  }
}

bool StereoOdometry::needsKeyframe() const {
  std::vector<double> parallax;  // px, that of the next frame, should everything move on as it did
  for (const Track& track : tracks_) {
    if (!track.inlier) continue;
    parallax.push_back((track.in_image.left_px - track.keyframe_px).norm() +
                       (track.in_image.left_px - track.last_px).norm());
  }
  if (static_cast<double>(parallax.size()) <
      params_.keyframes.min_tracked_share * static_cast<double>(keyframe_inliers_))
    return true;
  const auto middle = parallax.begin() + static_cast<std::ptrdiff_t>(parallax.size() / 2);
  std::nth_element(parallax.begin(), middle, parallax.end());
  return *middle > params_.keyframes.max_parallax_px;
}

void StereoOdometry::makeKeyframe(const Images& images, FrameResult& result) {
  for (Track& track : tracks_) {
    track.alive = track.alive && track.inlier;
    track.keyframe_px = track.in_image.left_px;
  }
  replenish(images, result);
  keyframe_image_ = images.left;
  keyframe_inliers_ = static_cast<std::size_t>(
      std::count_if(tracks_.begin(), tracks_.end(), [](const Track& track) { return track.alive; }));
  ++keyframe_id_;
  result.keyframe = true;
  dropOldFrames();
  compact();
}

void StereoOdometry::replenish(const Images& images, FrameResult& result) {
  std::vector<cv::Point2f> occupied;
  for (const Track& track : tracks_) {
    if (track.alive) occupied.push_back(vision::toCv(track.in_image.left_px));
  }
  const vision::StereoView& view = window_.back().view;
  const Eigen::Isometry3d T_world_camera = view.T_camera_world.inverse();
  // At the very start nothing is known of the motion between the stamps.
  const double slack_px =
      window_.size() == 1 && window_.back().skewed ? epipolarSlack(window_.back().late_sigma) : 0.0;
  const std::vector<cv::Point2f> corners = detector_.detect(images.left.level(0), occupied);
  result.features_detected = static_cast<std::uint32_t>(corners.size());
  for (const cv::Point2f& corner : corners) {
    const Eigen::Vector2d px = vision::toEigen(corner);
    const auto match = stereo_.search(images.left, images.right, view.T_late_camera, px, slack_px);
    if (!match) continue;
    Landmark landmark;
    landmark.id = next_id_++;
    landmark.T_world_anchor = T_world_camera;
    landmark.ray_depth.z() = match->depth.inverse_depth;
    Track track;
    track.keyframe_px = track.last_px = px;
    track.in_image.left_px = px;
    track.in_image.right_px = match->right_px;
    track.in_image.has_right = true;
    track.seen = track.in_image;
    placeAtStamp(landmark, track.seen, view, row_twist_);
    track.found = track.inlier = true;
    landmark.views.push_back({static_cast<int>(window_.size()) - 1, track.seen});
    landmarks_.push_back(landmark);
    tracks_.push_back(track);
  }
}

void StereoOdometry::dropOldFrames() {
  const int excess = static_cast<int>(window_.size()) - params_.keyframes.window;
  if (excess <= 0) return;
  window_.erase(window_.begin(), window_.begin() + excess);
  for (Landmark& landmark : landmarks_) {
    auto& views = landmark.views;
    views.erase(std::remove_if(views.begin(), views.end(),
                               [excess](const LandmarkView& view) { return view.frame < excess; }),
                views.end());
    for (LandmarkView& view : views) view.frame -= excess;
  }
}

void StereoOdometry::compact() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    if (!tracks_[i].alive && landmarks_[i].views.size() < 2) continue;
    if (kept != i) {
      landmarks_[kept] = std::move(landmarks_[i]);
      tracks_[kept] = tracks_[i];
    }
    ++kept;
  }
  landmarks_.resize(kept);
  tracks_.resize(kept);
}

}  // namespace stereo_nav::odometry
