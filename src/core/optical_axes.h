#pragma once

#include <Eigen/Core>

namespace stereo_nav {

/// R_body_optical takes coordinates in the optical axes (x right, y down, z forward) into those of a body
/// that looks along its x axis (x forward, y left, z up; REP-103).
inline Eigen::Matrix3d opticalToBody() {
  Eigen::Matrix3d R_body_optical;
  R_body_optical << 0.0, 0.0, 1.0,  //
      -1.0, 0.0, 0.0,               //
      0.0, -1.0, 0.0;
  return R_body_optical;
}

}  // namespace stereo_nav
