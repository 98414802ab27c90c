#pragma once

#include <Eigen/Geometry>

namespace stereo_nav {

/// A twist, or a small motion: translation in m, rotation in rad.
using Vector6d = Eigen::Matrix<double, 6, 1>;
/// The covariance of a twist, or a Jacobian with respect to one.
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The cross product as a matrix: hat(v) w = v x w.
Eigen::Matrix3d hat(const Eigen::Vector3d& v);

/// SO(3): the rotation about the direction of the vector `angle` by its length in rad, as a quaternion.
Eigen::Quaterniond expQuaternion(const Eigen::Vector3d& angle);
/// The same as a matrix.
Eigen::Matrix3d expRotation(const Eigen::Vector3d& angle);

/// The inverse of expQuaternion(): a rotation vector in rad, at most pi long.
Eigen::Vector3d logRotation(const Eigen::Quaterniond& q);
/// The inverse of expRotation().
Eigen::Vector3d logRotation(const Eigen::Matrix3d& R);

/// Left Jacobian of SO(3): exp(angle + d) = exp(leftJacobian(angle) d) exp(angle) for a small d
/// (Barfoot 2017, State Estimation for Robotics, eq. 7.77).
Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& angle);

/// SE(3). A twist is (translation in m, rotation in rad). expMotion() is the motion of a body that moves with
/// that constant velocity, in its own axes, for one unit of time; logMotion() is the inverse (Barfoot 2017,
/// eq. 7.85 and 7.86).
Eigen::Isometry3d expMotion(const Vector6d& twist);
/// The inverse of expMotion().
Vector6d logMotion(const Eigen::Isometry3d& T);

/// Takes a small motion that is expressed in frame b into frame a: T_a_b exp(d) = exp(adjoint(T_a_b) d)
/// T_a_b.
Matrix6d adjoint(const Eigen::Isometry3d& T_a_b);

/// A covariance of (translation, rotation) whose axes are those of frame b, in the axes of frame a: both
/// turn, neither moves.
Matrix6d turned(const Eigen::Matrix3d& R_a_b, const Matrix6d& covariance);

/// d log(exp(e) T) / d e at e = 0, given twist = log T: the inverse of the left Jacobian of SE(3), as a
/// series to second order in the twist. The error is the fourth power of the twist over 720, which is below
/// 1e-9 for the motions between two frames.
Matrix6d inverseLeftJacobian(const Vector6d& twist);

/// The same rigid motion with its rotation made orthonormal again.
Eigen::Isometry3d renormalised(const Eigen::Isometry3d& T);

}  // namespace stereo_nav
