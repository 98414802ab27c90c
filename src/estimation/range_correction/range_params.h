#pragma once

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::estimation {

/// Parameters of the correction of the pose by range finders against the walls of a map.
struct RangeParams {
  int readings = 5;
  double window_s = 1.0;
  double min_way_m = 0.1;
  double min_turn_rad = 0.1;
  double reading_sigma_m = 0.02;
  double bias_sigma_m = 0.03;
  double bias_walk_m = 0.0005;
  double wall_sigma_m = 0.01;
  double foreign_share = 0.1;
  double way_noise_m = 0.02;
  double turn_noise_rad = 0.02;

  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::estimation
