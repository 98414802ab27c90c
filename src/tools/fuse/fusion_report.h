#pragma once

#include <string>
#include <vector>

#include "tools/fuse/fuse_run.h"

namespace stereo_nav::tools {

/// Errors of the pose against the truth, both beginning at the same pose, and whether its covariance explains
/// them.
struct PoseErrors {
  std::size_t poses = 0;  ///< with truth
  double rmse_x_m = 0.0, rmse_y_m = 0.0, rmse_yaw_deg = 0.0;
  double mae_x_m = 0.0, mae_y_m = 0.0, mae_yaw_deg = 0.0;
  /// abs(sum of errors) / sqrt(N), the formula of the work of 2024: errors of opposite signs cancel.
  double published_x_m = 0.0, published_y_m = 0.0;
  int nees_expected = 3;
  double nees_mean = 0.0;
  double nees_inside_95_percent = 0.0;
};

/// Without truth, all zero. The pose of the start counts as exact in both.
PoseErrors poseErrors(const FuseRun& run);

/// fusion.json: errors, and for each channel what became of its measurements, its NIS, and its share of the
/// information that the filter took in.
std::string fusionJson(const FuseRun& run, const PoseErrors& errors);

/// The same for a reader.
void printFusion(const FuseRun& run, const PoseErrors& errors);

}  // namespace stereo_nav::tools
