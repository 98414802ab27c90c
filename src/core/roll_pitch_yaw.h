#pragma once

#include <Eigen/Geometry>

namespace stereo_nav {

/// Rotations about the fixed x, then y, then z axis (REP-103, URDF): R = Rz(yaw) Ry(pitch) Rx(roll), in rad.
struct RollPitchYaw {
  double roll = 0.0;   ///< -pi to pi
  double pitch = 0.0;  ///< -pi/2 to pi/2
  double yaw = 0.0;    ///< -pi to pi

  static RollPitchYaw fromDegrees(double roll_deg, double pitch_deg, double yaw_deg);

  /// Where the x axis becomes vertical, roll and yaw turn about one axis: the whole rotation is yaw.
  static RollPitchYaw of(const Eigen::Matrix3d& R);

  Eigen::Quaterniond quaternion() const;
  Eigen::Matrix3d rotation() const { return quaternion().toRotationMatrix(); }
};

}  // namespace stereo_nav
