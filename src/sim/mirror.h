#pragma once

#include <Eigen/Geometry>

namespace stereo_nav::sim {

/// A smooth plane that mirrors a part of the light and lets the rest through: a pane of glass, or the varnish
/// of a floor. Its own frame has z along the normal, and the middle of its rectangle as origin.
struct Mirror {
  Eigen::Isometry3d T_world_mirror = Eigen::Isometry3d::Identity();
  double half_x_m = 0.5;
  double half_y_m = 0.5;
  double reflectance = 0.04;  ///< of light that falls on it straight

  /// The world as the mirror shows it: a point on one side goes to the same place on the other.
  Eigen::Isometry3d reflection() const;
  /// Distance of a point in front of (positive) or behind the plane.
  double side(const Eigen::Vector3d& p_world) const;
};

/// Share of the light that is mirrored where it falls on the plane at this cosine to the normal: Schlick's
/// approximation of Fresnel's equations ("An inexpensive BRDF model", 1994, equation 24).
float mirroredShare(float reflectance, float cosine);

}  // namespace stereo_nav::sim
