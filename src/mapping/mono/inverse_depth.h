#pragma once

#include <Eigen/Core>

#include "stereo_nav/core/lie.h"

namespace stereo_nav::mapping {

/// A landmark as it is seen first: (x, y, z, theta, phi, rho). The camera stood at (x, y, z), in m, and saw
/// it in the direction of ray(theta, phi), in rad, at the inverse depth rho, in 1/m (Civera, Davison and
/// Montiel 2008, "Inverse depth parametrization for monocular SLAM"). Points near infinity and of unknown
/// depth are Gaussian in it. World axes as those of an optical frame: x right, y down, z forward.
///
/// The unit ray m = (sin theta cos phi, -sin phi, cos theta cos phi).
Eigen::Vector3d inverseDepthRay(double theta_rad, double phi_rad);

/// Derivative of the ray by (theta, phi).
Eigen::Matrix<double, 3, 2> inverseDepthRayByAngles(double theta_rad, double phi_rad);

/// (theta, phi) of a direction, which needs no unit length.
Eigen::Vector2d anglesOf(const Eigen::Vector3d& direction);
/// Its derivative.
Eigen::Matrix<double, 2, 3> anglesByDirection(const Eigen::Vector3d& direction);

/// The point (x, y, z) + m / rho, and its derivative by the six numbers. rho is above 0.
Eigen::Vector3d pointOf(const Vector6d& inverse_depth);
Eigen::Matrix<double, 3, 6> pointByInverseDepth(const Vector6d& inverse_depth);

/// The linearity index of Civera et al. 2008, eq. 29: how far from a Gaussian the depth is, seen from
/// `p_camera_world`. Below 0.1 the point may be kept as XYZ.
double linearityIndex(const Vector6d& inverse_depth, double rho_sigma, const Eigen::Vector3d& p_camera_world);

}  // namespace stereo_nav::mapping
