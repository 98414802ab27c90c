#pragma once

#include <Eigen/Core>
#include <vector>

#include "odometry/laser/line_map.h"
#include "odometry/laser/pose_filter.h"

namespace stereo_nav::odometry {

/// The shift (axes of odom: m, m, rad) of the prior's pose at which most points of a scan fall onto points of
/// the map, among all within three standard deviations of the prior, on a raster (Olson 2009, "Real-time
/// correlative scan matching"). It needs no start near the solution, and is as exact as its raster.
/// `points_base` are undistorted.
Eigen::Vector3d searchShift(const std::vector<Eigen::Vector2d>& points_base, const LineMap& map,
                            const PlanarState& prior, const Eigen::Matrix3d& prior_covariance);

/// Raster of the search.
constexpr double kSearchStep_m = 0.1;
constexpr double kSearchStep_rad = 0.025;

}  // namespace stereo_nav::odometry
