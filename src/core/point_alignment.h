#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace stereo_nav {

/// A rigid motion with a uniform scale: p_target = scale * R * p_source + t.
struct Similarity {
  double scale = 1.0;
  Eigen::Matrix3d R_target_source = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t_target_m = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& p_source) const {
    return scale * (R_target_source * p_source) + t_target_m;
  }
};

/// What a similarity may do beside moving.
struct SimilarityFreedom {
  bool scale = false;   ///< change the size
  bool planar = false;  ///< turn about z only
};

/// The rigid motion (no scale) T_target_source that minimises sum |target_i - T_target_source * source_i|^2;
/// Umeyama, "Least-squares estimation of transformation parameters between two point patterns", PAMI 1991.
/// Needs as many targets as sources, at least one. Points on a line leave the rotation about it open; the
/// residual is unaffected.
Eigen::Isometry3d alignRigidly(const std::vector<Eigen::Vector3d>& source,
                               const std::vector<Eigen::Vector3d>& target);

/// The same with the freedom that is given (Umeyama, eq. 39 to 42). With `planar` the rotation is about z, by
/// the angle that has the horizontal parts agree best. With `scale` the sources must not all be one point.
Similarity alignSimilarly(const std::vector<Eigen::Vector3d>& source,
                          const std::vector<Eigen::Vector3d>& target, const SimilarityFreedom& freedom);

}  // namespace stereo_nav
