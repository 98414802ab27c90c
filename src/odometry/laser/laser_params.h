#pragma once

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::odometry {

/// How the laser odometry gets from scan to scan.
enum class LaserMethod {
  kScanMatching,  ///< registration to a map, with wheels and gyroscope
  kRangeFlow      ///< RangeFlow between two scans, as published: the laser alone
};

/// Parameters of the laser odometry: the laser's noise, what wheels and gyroscope are worth, and the map.
struct LaserParams {
  LaserMethod method = LaserMethod::kScanMatching;
  double range_sigma_m = 0.01;
  double range_sigma_share = 0.01;
  double wheel_slip_sigma = 0.05;
  double wheel_turn_sigma = 0.06;
  double wheel_scale_sigma = 0.1;
  double gyro_sigma_rad = 0.0005;
  double gyro_bias_sigma_rad_per_s = 0.01;
  double acceleration_sigma_m_per_s2 = 0.5;
  double turn_acceleration_sigma_rad_per_s2 = 2.0;
  double keyframe_distance_m = 0.3;
  double keyframe_turn_deg = 20.0;
  int keyframes = 30;
  double cell_m = 0.1;
  double least_information_share = 0.01;
  double least_inlier_share = 0.4;

  /// Standard deviation of a range, m.
  double rangeSigma_m(double range_m) const { return range_sigma_m + range_sigma_share * range_m; }

  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::odometry
