#pragma once

#include <Eigen/Geometry>

#include "stereo_nav/core/lie.h"

namespace stereo_nav {

/// SE(2): motion in the plane. A planar twist is (forward m, left m, rotation rad). expPlanar() is the motion
/// of a body that moves with that constant velocity, in its own axes, for one unit of time; logPlanar() is
/// the inverse, with a rotation from -pi to pi (Sola et al. 2018, "A micro Lie theory", eq. 156 to 158).
Eigen::Isometry2d expPlanar(const Eigen::Vector3d& twist);
Eigen::Vector3d logPlanar(const Eigen::Isometry2d& T);

/// The rotation of a planar pose, from -pi to pi.
double yawOf(const Eigen::Isometry2d& T);

/// The part of a pose in space that lies in the x-y plane; its rotation is that of the x axis, seen from
/// above.
Eigen::Isometry2d planarPart(const Eigen::Isometry3d& T);

/// A pose in the x-y plane as one in space.
Eigen::Isometry3d inSpace(const Eigen::Isometry2d& T);

/// Takes a small planar motion that is expressed in frame b into frame a (Sola et al., eq. 159).
Eigen::Matrix3d adjointPlanar(const Eigen::Isometry2d& T_a_b);

/// exp(twist + d) = exp(leftJacobianPlanar(twist) d) exp(twist) for a small d (Sola et al., eq. 164).
Eigen::Matrix3d leftJacobianPlanar(const Eigen::Vector3d& twist);

/// The covariance of a pose, given in the axes of the base, in those of odom.
Eigen::Matrix3d inAxesOf(const Eigen::Isometry2d& T_odom_base, const Eigen::Matrix3d& covariance);

/// The largest deviation that a covariance in the plane has in any direction.
double largestSigma(const Eigen::Matrix2d& covariance);

/// The covariance of a pose in the plane (x, y, yaw) as one of a pose in space (x, y, z, and rotations about
/// them): nothing is said about the other three, whose variances are 1e6.
Matrix6d spatialCovariance(const Eigen::Matrix3d& planar);
/// The part of such a covariance that lies in the plane.
Eigen::Matrix3d planarCovariance(const Matrix6d& spatial);

}  // namespace stereo_nav
