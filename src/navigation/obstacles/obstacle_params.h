#pragma once

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::navigation {

/// Parameters of the local grid of obstacles: config/obstacles.yaml.
struct ObstacleParams {
  double size_m = 8.0;
  double resolution_m = 0.05;
  double range_max_m = 4.0;
  double min_height_m = 0.05;
  double max_height_m = 1.5;
  double hole_depth_m = 0.05;
  double disparity_sigma_px = 0.4;
  double max_tilt_deg = 2.0;
  int column_px = 2;
  double memory_s = 10.0;
  double near_m = 1.5, near_memory_s = 60.0;

  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::navigation
