#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "stereo_nav/core/trajectory.h"

namespace stereo_nav::eval {

/// Limits for looking up a pose by time.
struct AssociationParams {
  double max_gap_s = 0.25;          ///< two neighbours further apart than this leave a hole
  double max_difference_s = 0.002;  ///< in a hole or beyond the ends, the nearest pose counts if this near
};

/// Ground truth at an instant. Ground truth is usually much denser than the images (EuRoC: 200 Hz against 20
/// Hz) and its stamps are its own, so the pose is interpolated between the two neighbours (position linearly,
/// rotation by slerp) rather than taken from the nearest one: at 200 Hz and 1 m/s "nearest" alone would cost
/// up to 2.5 mm. A stamp that the ground truth contains gives exactly that pose. Returns nothing where the
/// trajectory does not cover the instant.
std::optional<Eigen::Isometry3d> poseAt(const Trajectory& trajectory, double time_s,
                                        const AssociationParams& params = {});

}  // namespace stereo_nav::eval
