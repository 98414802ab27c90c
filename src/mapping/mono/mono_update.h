#pragma once

#include <vector>

#include "mapping/mono/pixel_prediction.h"

namespace stereo_nav::mapping {

/// A landmark that was looked for, and where it was found.
struct PixelMatch {
  std::size_t block = 0;  ///< index into MonoState::blocks
  ExpectedPixel expected;
  Eigen::Vector2d found_px = Eigen::Vector2d::Zero();

  Eigen::Vector2d innovation() const { return found_px - expected.px; }
};

/// What the update of a frame is computed with.
struct ImageModel {
  MonoCamera camera;
  double pixel_sigma_px = 0.5;
  double readout_s = 0.0;
};

/// The correction of the whole state by these matches at once. False, and nothing is changed, when they
/// contradict each other numerically.
bool correctByPixels(MonoState& state, const std::vector<PixelMatch>& matches, double pixel_sigma_px);

}  // namespace stereo_nav::mapping
