#pragma once

#include <cmath>

namespace stereo_nav {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadPerDeg = kPi / 180.0;
constexpr double kDegPerRad = 180.0 / kPi;

/// Returns the same direction as an angle within [-180, 180] degrees.
inline double wrapDegrees(double angle_deg) {
  return std::remainder(angle_deg, 360.0);
}

/// Returns the same direction as an angle within [-pi, pi] rad.
inline double wrapRadians(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * kPi);
}

}  // namespace stereo_nav
