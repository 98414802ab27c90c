#pragma once

#include <Eigen/Geometry>

#include "stereo_nav/core/lie.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::estimation {

/// What a robot that drives on a floor knows of its pose.
struct FloorParams {
  bool on = false;                ///< the robot drives on the plane z = 0 of its start
  double height_sigma_m = 0.005;  ///< of base_link above the plane: bumps, tyres
  double tilt_sigma_rad = 0.01;  ///< of its roll and pitch against the plane: suspension, slopes of the floor

  /// Names, ranges and meanings of the parameters.
  void describe(ParameterVisitor& visitor);
};

/// A pose of base_link and its covariance: x y z, then rotation about x y z, axes of odom: m, rad.
struct UncertainPose {
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();  ///< base_link in odom
  Matrix6d covariance = Matrix6d::Zero();                         ///< of it
};

/// The pose given that base_link is `height_m` above the plane z = 0 of odom and level, each within its sigma
/// (one step of a Kalman filter, Joseph form). Errors of the floor are the same from frame to frame: they are
/// not averaged, so that this is to be applied to the poses of the odometry, never to its own results. A pose
/// that contradicts the floor by more than both sigmas explain, as on a ramp, gives it less weight: the
/// sigmas grow with the contradiction.
UncertainPose onFloor(const FloorParams& params, double height_m, const UncertainPose& pose);

}  // namespace stereo_nav::estimation
