#pragma once

#include <vector>

#include "odometry/stereo/frame_prediction.h"
#include "odometry/stereo/local_map.h"
#include "odometry/stereo/track.h"
#include "vision/patch_tracker.h"

namespace stereo_nav::odometry {

/// Follows the features of the last keyframe through the left images. Patches are always compared with the
/// keyframe, so that their positions do not drift from frame to frame.
class FeatureFollower {
 public:
  FeatureFollower(const vision::PatchTrackerParams& params, int pyramid_levels)
      : tracker_(params), coarsest_level_(pyramid_levels - 1) {}

  /// Forgets the keyframe and its features.
  void reset();

  std::vector<Track>& tracks() { return tracks_; }
  const std::vector<Track>& tracks() const { return tracks_; }

  /// Copies the positions of the tracks' landmarks from the map.
  void updatePoints(const LocalMap& map);

  /// Searches for the features in `left` at their places in `prediction`, then at their last places, then
  /// after an unpredicted turn of the camera as a whole, then at half the resolution for images with motion
  /// blur. If not `is_predicted`, the search begins at their last places.
  void follow(const vision::ImagePyramid& left, const FramePrediction& prediction, bool is_predicted);
  /// Searches once more, near `prediction`, for the features that were not found or were no inliers. Returns
  /// the tracks that were found.
  TrackIndices recover(const vision::ImagePyramid& left, const FramePrediction& prediction);

  /// Makes the current frame the keyframe: inliers are kept, other tracks are dropped.
  void startKeyframe(const vision::ImagePyramid& left);
  /// A new feature of the keyframe.
  void add(const Track& track) { tracks_.push_back(track); }
  /// Removes the tracks whose landmark the map has given up.
  void removeTracksWithout(const LocalMap& map);

 private:
  struct Search {
    Eigen::Vector2d guess_px;
    int coarsest_level;
    Eigen::Matrix2f patch_step;
    int finest_level;
  };
  bool find(const vision::ImagePyramid& left, const Search& search, Track& track) const;
  void beginFrame();
  bool lostMany() const;
  void findAfterTurn(const vision::ImagePyramid& left);
  void findBlurred(const vision::ImagePyramid& left, const FramePrediction& prediction, bool is_predicted);

  vision::PatchTracker tracker_;
  int coarsest_level_;
  vision::ImagePyramid keyframe_image_;
  std::vector<Track> tracks_;
};

}  // namespace stereo_nav::odometry
