#include "core/local_tangent_plane.h"

#include <cmath>

#include "core/angles.h"

namespace stereo_nav {

Eigen::Vector3d eastNorthUp_m(const Eigen::Vector3d& origin, const Eigen::Vector3d& place) {
  // Radii of curvature of WGS 84 along the meridian and across it.
  constexpr double kRadius_m = 6378137.0, kEccentricity2 = 6.69437999014e-3;
  const double sine = std::sin(origin[0] * kRadPerDeg);
  const double w = std::sqrt(1.0 - kEccentricity2 * sine * sine);
  const double meridian_m = kRadius_m * (1.0 - kEccentricity2) / (w * w * w);
  return {wrapRadians((place[1] - origin[1]) * kRadPerDeg) * (kRadius_m / w + origin[2]) *
              std::cos(origin[0] * kRadPerDeg),
          (place[0] - origin[0]) * kRadPerDeg * (meridian_m + origin[2]), place[2] - origin[2]};
}

}  // namespace stereo_nav
