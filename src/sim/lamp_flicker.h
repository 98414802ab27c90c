#pragma once

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::sim {

/// Lamps on alternating current: their light swells and sinks twice in each period of the mains.
struct FlickerParams {
  double mains_hz = 0.0;  ///< 0: steady light
  double depth = 0.2;     ///< amplitude of the light's change as a share of its mean

  void describe(ParameterVisitor& visitor);
};

/// Mean of 1 + depth * cos(2 pi * 2 mains_hz * t + phase) over an exposure of `exposure_s` around
/// `middle_s`: what an exposure of whole periods (10 ms at 50 Hz) does not see.
double lampLight(const FlickerParams& flicker, double phase_rad, double middle_s, double exposure_s);

}  // namespace stereo_nav::sim
