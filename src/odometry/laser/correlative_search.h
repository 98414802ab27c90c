#pragma once

#include <Eigen/Core>
#include <vector>

#include "odometry/laser/pose_filter.h"
#include "odometry/laser/search_raster.h"

namespace stereo_nav::odometry {

/// The shifts (axes of odom: m, m, rad) of the prior's pose at which most points of a scan fall onto points
/// of the map, among all within three standard deviations of the prior, on a raster (Olson 2009, "Real-time
/// correlative scan matching": a coarse raster says where the fine one is looked at). They need no start near
/// the solution, and are as exact as the raster. At most `kSearchResults`, the best one first, none beside a
/// better one: places that look alike differ by less than the raster's errors, and only a registration at
/// each of them tells them apart. `points_base` are undistorted; the map is drawn on `raster` around the
/// prior's position.
std::vector<Eigen::Vector3d> searchShifts(const std::vector<Eigen::Vector2d>& points_base,
                                          const SearchRaster& raster, const PlanarState& prior,
                                          const Eigen::Matrix3d& prior_covariance);

/// What is compared: the share of points on the map against the squared shift over the prior's covariance, in
/// the logarithm of a likelihood. A scan all on the map outweighs any prior.
double searchScore(double share, double squared_shift);

constexpr std::size_t kSearchResults = 5;
/// Steps of the search.
constexpr double kSearchStep_m = SearchRaster::kCell_m;
constexpr double kSearchStep_rad = 0.025;

}  // namespace stereo_nav::odometry
