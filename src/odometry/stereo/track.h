#pragma once

#include <cstdint>
#include <vector>

#include "odometry/stereo/motion_prior.h"
#include "odometry/stereo/pose_estimator.h"
#include "vision/rolling_shutter.h"

namespace stereo_nav::odometry {

/// How a landmark is followed through the images since the last keyframe.
struct Track {
  std::uint64_t landmark_id = 0;
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  ///< of the landmark, as the map has it in this frame
  Eigen::Vector2d keyframe_px = Eigen::Vector2d::Zero();  ///< in the left image of the last keyframe
  Eigen::Vector2d previous_px = Eigen::Vector2d::Zero();  ///< in the left image where it last was an inlier
  vision::StereoObservation in_image;                     ///< pixels of the current images
  vision::StereoObservation at_stamp;  ///< the same as a global shutter would have seen them
  bool alive = true;                   ///< it is looked for in the next frame
  bool found = false;                  ///< it was found in the current frame
  bool inlier = false;                 ///< it agrees with the motion of the current frame
  bool fresh = true;                   ///< it was detected in the current frame
  bool reliable = true;   ///< it may decide the motion; otherwise it is only judged by the motion
  int confirmations = 0;  ///< earlier frames in which it was an inlier, that of its detection included
};

using TrackIndices = std::vector<std::size_t>;

TrackIndices foundTracks(const std::vector<Track>& tracks);
std::size_t aliveTracks(const std::vector<Track>& tracks);

/// The motion is decided by tracks that have moved with the scene for some frames, if there are enough of
/// them: an object that enters the view and moves on its own must not decide the motion once two frames
/// show it.
/// `min_inliers` is the number that a motion needs.
void selectReliableTracks(int min_inliers, std::vector<Track>& tracks);

/// Sets `at_stamp` of the tracks that were found, for a rig that moves with `twist` in the pose `view`.
void compensateRollingShutter(const vision::RollingShutter& shutter, const vision::StereoView& view,
                              const Vector6d& twist, std::vector<Track>& tracks);

/// The pixel at which the left image of `view` would show the track's point at its stamp; `previous_px` if
/// the point is not in front of the camera.
Eigen::Vector2d predictedPixel(const vision::StereoCalibration& calibration, const vision::StereoView& view,
                               const Track& track);

/// Found tracks whose left pixel lies at most `max_error_px` from its projection by `view`.
TrackIndices tracksNear(const vision::StereoCalibration& calibration, const vision::StereoView& view,
                        double max_error_px, const std::vector<Track>& tracks);

/// The observations from which the pose is estimated.
std::vector<MapObservation> observations(const std::vector<Track>& tracks, const TrackIndices& selected);

}  // namespace stereo_nav::odometry
