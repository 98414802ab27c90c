#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "odometry/laser/line_map.h"
#include "odometry/laser/sweep.h"
#include "odometry/laser/told_directions.h"

namespace stereo_nav::odometry {

/// What the map and the prior make of a scan.
struct Registration {
  Vector6d shift = Vector6d::Zero();  ///< of the prior's pose (axes of odom: m, m, rad) and correction
  Matrix6d covariance = Matrix6d::Zero();
  Matrix6d contraction = Matrix6d::Identity();  ///< takes the prior's errors to those that the scan leaves
  Eigen::Matrix3d scan_covariance =
      Eigen::Matrix3d::Zero();  ///< of the pose by the scan alone, where it tells
  ToldDirections directions;
  double inlier_share = 0.0;    ///< of the points
  double residual_scale = 1.0;  ///< of the residuals of points on the map; 1: the noise is as expected
  double keyframes = 1.0;       ///< that saw the walls, mean over the points
  double surprise = 0.0;        ///< squared shift over what the prior makes likely; 3 is expected at most
  int iterations = 0;
};

/// The most likely pose and correction of a prior and of the distances of a scan's points from the lines of
/// the map (point to line, Censi 2008), by Gauss-Newton with a Geman-McClure loss. What is
/// not told stays as it is, though it may be correlated with what is told (Schmidt 1966): a small error of a
/// wall's direction would else become a large motion along it. The correction changes the sweep, and with it
/// the points: a scan measures the velocity, too. `start` is where a search found the pose, a shift of it;
/// without, the prior is the start.
Registration registerScan(const LaserPoints& scan, const Sweep& sweep, const LineMap& map,
                          const PlanarState& prior, const Matrix6d& prior_covariance,
                          const LaserParams& params,
                          const std::optional<Eigen::Vector3d>& start = std::nullopt);

}  // namespace stereo_nav::odometry
