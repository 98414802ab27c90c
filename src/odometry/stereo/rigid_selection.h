#pragma once

#include "odometry/stereo/noisy_rigidity.h"
#include "odometry/stereo/track.h"

namespace stereo_nav::odometry {

struct CliqueParams {
  int clique_points = 200;
  int clique_budget = 2000;

  void describe(ParameterVisitor& visitor);
};

/// Tracks that moved as one rigid body.
struct RigidSelection {
  TrackIndices tracks;         ///< the largest rigid set
  std::size_t with_depth = 0;  ///< tracks that took part
};

/// The largest set of reliable tracks with depth whose mutual distances did not change from the previous
/// frame to this one (`view`), within their noise.
RigidSelection selectRigidTracks(const CliqueParams& params, const NoisyRigidityParams& rigidity,
                                 const vision::StereoCalibration& calibration,
                                 const Eigen::Isometry3d& T_previous_world, const vision::StereoView& view,
                                 const std::vector<Track>& tracks);

}  // namespace stereo_nav::odometry
