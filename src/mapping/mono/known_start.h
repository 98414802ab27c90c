#pragma once

#include <vector>

#include "mapping/mono/mono_slam.h"

namespace stereo_nav::mapping {

struct PoseWithCovariance {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< of CameraState's errors (dp, dtheta)
};

/// The pose of a camera that sees at least four points of known places, with `pixel_sigma_px` in each axis:
/// from the best of the solutions of a plane or of a general body, refined by Gauss-Newton. Throws InputError
/// where the points determine no pose, such as points on a line.
PoseWithCovariance knownStart(const MonoCamera& camera, const std::vector<KnownPoint>& points,
                              double pixel_sigma_px);

}  // namespace stereo_nav::mapping
