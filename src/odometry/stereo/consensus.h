#pragma once

#include <string>

#include "odometry/stereo/rigid_selection.h"
#include "odometry/stereo/track.h"

namespace stereo_nav::odometry {

/// What a motion is judged by besides the number of its inliers.
struct Consensus {
  const vision::StereoCalibration& calibration;
  const std::vector<Track>& tracks;  ///< with the inliers of the estimate
  const MotionPrior& prior;
  const PoseEstimate& estimate;
  bool is_expected = false;  ///< the pose lies where the last velocity leads to
};

/// Why the tracks do not tell the motion although enough of them agree on it; empty if they do. A handful of
/// tracks always agrees on some motion: how much that is worth depends on how many were asked, on how far
/// they lie apart, on what else is known of the motion, and on whether others tell of another one.
/// The rotation by the IMU is asked where less than `kStrongShare` of the tracks agree: against more it is
/// the IMU that is at fault.
std::string doubtAbout(const Consensus& consensus);

/// Whether the tracks that are no inliers agree on another motion, more than half as many as the inliers. For
/// motions that are not expected: what is known of the velocity decides between two.
bool hasRival(const Consensus& consensus, const CliqueParams& clique, const NoisyRigidityParams& rigidity,
              const PoseEstimator& estimator, double max_error_px);

/// Whether the motion rests on a few tracks from which the others differ: near ones, mostly, that are fixed
/// to the camera or move on their own, while the far ones tell but the rotation. For the first motions of a
/// map.
bool restsOnFew(const Consensus& consensus, const PoseEstimator& estimator, double max_error_px);

/// Why the second frame after the start of a map does not confirm what the first one said; empty if it does:
/// what was rigid then has to be rigid still.
std::string doubtAboutStart(const std::vector<Track>& tracks, int min_inliers);

/// Of the live tracks; fewer than these may belong to something that moves on its own, or be chance.
constexpr double kStrongShare = 0.6;

}  // namespace stereo_nav::odometry
