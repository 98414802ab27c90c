#pragma once

#include <vector>

#include "odometry/stereo/local_map.h"
#include "odometry/stereo/right_stamp_error.h"
#include "odometry/stereo/stereo_images.h"
#include "odometry/stereo/track.h"
#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::odometry {

/// Adds what became of the tracks of a frame to its result; `T_camera_world` is the pose of the last frame
/// that had one.
void reportTracks(const std::vector<Track>& tracks, const Eigen::Isometry3d& T_camera_world,
                  FrameResult& result);

/// Adds to the features of a keyframe where a global shutter would have seen them, and their disparities by
/// the map, with standard deviations.
void reportKeyframe(const std::vector<Track>& tracks, const LocalMap& map,
                    const vision::StereoCalibration& calibration, FrameResult& result);

/// Why a frame is lost or a map could not begin.
std::string tooFewLandmarks(std::size_t landmarks, int needed);
std::string tooFewInliers(std::size_t inliers, std::size_t tracked, int needed);
std::string blankImage(std::size_t corners);
std::string moverFillsView();
/// Why a motion that nothing predicts is not believed, and why the first one of a map is not yet.
std::string ambiguous();
std::string unconfirmed();

/// Whether the images of a frame were taken at different times, and what is known of the right stamps:
/// without an estimate, what is taken off them.
void reportTimes(const FrameTimes& times, const RightStampError& stamps, FrameResult& result);

}  // namespace stereo_nav::odometry
