#pragma once

#include <Eigen/Core>

namespace stereo_nav {

/// Position east, north and up in m of a place on the earth, seen from another one some kilometres away at
/// most: degrees of latitude and longitude times the radii of curvature of WGS 84 at the origin. Both are
/// (latitude in degrees, longitude in degrees, height above the ellipsoid in m), as in a NavSatFix.
Eigen::Vector3d eastNorthUp_m(const Eigen::Vector3d& origin, const Eigen::Vector3d& place);

}  // namespace stereo_nav
