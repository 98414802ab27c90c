#pragma once

#include <Eigen/Core>
#include <vector>

namespace stereo_nav::odometry {

/// What a scan tells of a motion of the base: the information of its points (J^T W J of forward m, left m,
/// rotation rad), and what of it the noise of the walls' normals feigns.
struct ScanInformation {
  Eigen::Matrix3d told = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d feigned = Eigen::Matrix3d::Zero();
  double weight = 0.0;   ///< sum of the weights
  double lever_m = 1.0;  ///< root mean square of the points' distances, which makes a rotation a way
};

/// The motions that a scan tells.
struct ToldDirections {
  /// Takes a motion to the part of it that is told: P P = P.
  Eigen::Matrix3d projection = Eigen::Matrix3d::Identity();
  /// Told motions that all others are sums of, a column each.
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> basis = Eigen::Matrix3d::Identity();
  /// Takes a motion to its parts along the basis.
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3> parts = Eigen::Matrix3d::Identity();
  /// Motions that are not told, of length 1 where a rotation counts with the lever: forward, left, rotation.
  std::vector<Eigen::Vector3d> untold;
  double least_share = 0.0;  ///< of the information, along the direction that is told least
};

/// Zhang et al. 2016, "On degeneracy of optimization-based state estimation problems": along eigenvectors of
/// the information with small eigenvalues nothing is solved for. Eigenvalues are taken as shares of the
/// weight, less what the noise of the normals feigns, so that the threshold is no matter of the number of
/// beams or of their noise: walls all across a direction make a share of 1.
ToldDirections toldDirections(const ScanInformation& information, double least_share);

}  // namespace stereo_nav::odometry
