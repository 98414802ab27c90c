#include "odometry/stereo/feature_follower.h"

#include <algorithm>

#include "vision/image_shift.h"
#include "vision/pixel.h"

namespace stereo_nav::odometry {

void FeatureFollower::reset() {
  keyframe_image_ = vision::ImagePyramid();
  tracks_.clear();
}

void FeatureFollower::updatePoints(const LocalMap& map) {
  for (Track& track : tracks_) {
    if (const Landmark* landmark = map.find(track.landmark_id)) track.p_world = landmark->p_world();
  }
}

void FeatureFollower::follow(const vision::ImagePyramid& left, const FramePrediction& prediction,
                             bool is_predicted) {
  beginFrame();
  for (Track& track : tracks_) {
    if (is_predicted &&
        find(left,
             {prediction.leftPixel(track), std::min(2, coarsest_level_), prediction.patchStep(track), 0},
             track))
      continue;
    find(left, {track.previous_px, coarsest_level_, Eigen::Matrix2f::Identity(), 0}, track);
  }
  if (lostMany()) findAfterTurn(left);
  if (lostMany()) findBlurred(left, prediction, is_predicted);
}

TrackIndices FeatureFollower::recover(const vision::ImagePyramid& left, const FramePrediction& prediction) {
  TrackIndices recovered;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Track& track = tracks_[i];
    if (!track.alive || track.inlier) continue;
    if (find(left, {prediction.leftPixel(track), 1, prediction.patchStep(track), 0}, track))
      recovered.push_back(i);
  }
  return recovered;
}

void FeatureFollower::startKeyframe(const vision::ImagePyramid& left) {
  for (Track& track : tracks_) {
    track.alive = track.alive && track.inlier;
    track.keyframe_px = track.in_image.left_px;
  }
  keyframe_image_ = left;
}

void FeatureFollower::removeTracksWithout(const LocalMap& map) {
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(),
                               [&map](const Track& track) { return map.find(track.landmark_id) == nullptr; }),
                tracks_.end());
}

bool FeatureFollower::find(const vision::ImagePyramid& left, const Search& search, Track& track) const {
  const auto match =
      tracker_.track(keyframe_image_, vision::toCv(track.keyframe_px), left, vision::toCv(search.guess_px),
                     search.coarsest_level, search.patch_step, search.finest_level);
  track.found = match.has_value();
  if (!match) return false;
  track.in_image.left_px = vision::toEigen(match->px);
  track.in_image.noise = 1 << search.finest_level;
  return true;
}

void FeatureFollower::beginFrame() {
  // Those that ended with the last keyframe were kept for its report only.
  tracks_.erase(
      std::remove_if(tracks_.begin(), tracks_.end(), [](const Track& track) { return !track.alive; }),
      tracks_.end());
  for (Track& track : tracks_) {
    if (track.inlier) {
      track.previous_px = track.in_image.left_px;
      ++track.confirmations;
    }
    track.fresh = false;
    track.inlier = false;
    track.found = false;
  }
}

bool FeatureFollower::lostMany() const {
  constexpr double kShare = 0.5;
  return static_cast<double>(foundTracks(tracks_).size()) <
         kShare * static_cast<double>(aliveTracks(tracks_));
}

void FeatureFollower::findAfterTurn(const vision::ImagePyramid& left) {
  const auto shift = vision::coarseShift(keyframe_image_, left);
  if (!shift) return;
  for (Track& track : tracks_) {
    if (track.found) continue;
    find(left, {track.keyframe_px + vision::toEigen(*shift), coarsest_level_, Eigen::Matrix2f::Identity(), 0},
         track);
  }
}

void FeatureFollower::findBlurred(const vision::ImagePyramid& left, const FramePrediction& prediction,
                                  bool is_predicted) {
  for (Track& track : tracks_) {
    if (track.found) continue;
    const Eigen::Vector2d guess_px = is_predicted ? prediction.leftPixel(track) : track.previous_px;
    find(left, {guess_px, coarsest_level_, prediction.patchStep(track), 1}, track);
  }
}

}  // namespace stereo_nav::odometry
