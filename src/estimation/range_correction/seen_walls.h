#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "grid/occupancy_grid.h"

namespace stereo_nav::estimation {

/// A beam of a range finder in the plane of the map.
struct Beam {
  Eigen::Vector2d p_map = Eigen::Vector2d::Zero();  ///< where it begins
  double direction_rad = 0.0;                       ///< of its middle, in the map
  double half_width_rad = 0.0;
  bool nearest = false;  ///< sound: the nearest point of the wall within the width answers, else its middle
};

/// A straight wall that a beam may mean.
struct SeenWall {
  Eigen::Vector2d normal;  ///< of length 1, away from the beam's origin
  double offset_m = 0.0;   ///< normal . p = offset for points of the wall
  double sigma_m = 0.0;    ///< how far the cells of the map lie from the line
};

/// The walls that a beam of the map may mean if its direction is known to `direction_sigma_rad`, from left to
/// right. Lines are fitted to the hits of a fan of rays, which is split at jumps of the distance and at
/// corners (iterative end-point fit: Ramer 1972; Nguyen et al. 2005, "A comparison of line extraction
/// algorithms"). Empty where nothing is within `range_m`.
std::vector<SeenWall> wallsOf(const grid::OccupancyGrid& map, const Beam& beam, double direction_sigma_rad,
                              double range_m);

/// Range at which a beam meets a wall, and what it changes by.
struct ExpectedRange {
  double range_m = 0.0;             ///< below zero: the wall lies behind
  double across_m = 0.0;            ///< light: how much nearer the nearest point within the width is
  double incidence = 1.0;           ///< cosine of the angle between beam and normal
  Eigen::Vector2d by_position;      ///< d range / d p_map
  double by_direction_m_rad = 0.0;  ///< d range / d direction
};
ExpectedRange expectedRange(const SeenWall& wall, const Beam& beam);

}  // namespace stereo_nav::estimation
