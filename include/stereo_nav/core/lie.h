#pragma once

#include <Eigen/Geometry>

namespace stereo_nav {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// [v]x, with [v]x w = v x w.
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// Rotation by the vector `angle` (rad) and back (Rodrigues); the logarithm is at most pi long.
Eigen::Matrix3d expRotation(const Eigen::Vector3d& angle);
Eigen::Vector3d logRotation(const Eigen::Matrix3d& R);

/// Twists are (translation m, rotation rad): exp of a constant twist over one unit of time, and back
/// (Barfoot 2017, State Estimation for Robotics, eq. 7.85 and 7.86).
Eigen::Isometry3d expMotion(const Vector6d& twist);
Vector6d logMotion(const Eigen::Isometry3d& T);

/// d log(exp(e) T) / d e at e = 0, given twist = log T; to second order in the twist, which is exact to 1e-4
/// for motions between frames.
Matrix6d inverseLeftJacobian(const Vector6d& twist);

/// The same rigid motion with its rotation made orthonormal again.
Eigen::Isometry3d renormalised(const Eigen::Isometry3d& T);

}  // namespace stereo_nav
