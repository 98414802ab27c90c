#pragma once

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::mapping {

/// How the camera is expected to move. Lengths are m where the scale is known, else units of the map.
struct MotionNoise {
  double acceleration_sigma = 2.0;
  double turn_acceleration_sigma = 3.0;

  void describe(ParameterVisitor& visitor);
};

/// What other sensors are worth to the filter.
struct MeasuredMotionParams {
  double gyro_sigma_rad_per_s = 0.1;
  double speed_sigma_m_per_s = 0.02;
  double speed_sigma_share = 0.03;

  void describe(ParameterVisitor& visitor);
};

/// How patches are found again.
struct PatchSearchParams {
  int window_px = 13;
  double min_correlation = 0.8;
  double min_texture = 4.0;
  double most_search_px = 30.0;

  void describe(ParameterVisitor& visitor);
};

/// Which matches agree (Civera, Grasa, Davison and Montiel 2010).
struct OnePointRansacParams {
  double threshold_px = 3.0;
  double probability = 0.99;
  double chi_square = 5.99;
  int most_hypotheses = 100;

  void describe(ParameterVisitor& visitor);
};

/// Parameters of SLAM with one camera.
struct MonoParams {
  double pixel_sigma_px = 1.0;
  double start_speed_sigma = 1.0;
  double start_turn_sigma_rad_per_s = 0.5;
  double inverse_depth_start = 0.2;
  double inverse_depth_sigma = 0.5;
  double linearity_index = 0.1;
  int most_landmarks = 60;
  int most_measured = 30;
  double least_found_share = 0.5;
  int fast_threshold = 20;
  MotionNoise motion;
  MeasuredMotionParams measured;
  PatchSearchParams search;
  OnePointRansacParams ransac;

  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::mapping
