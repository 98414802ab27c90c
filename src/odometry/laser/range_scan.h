#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "odometry/laser/laser_scan.h"

namespace stereo_nav::odometry {

/// Range as a function of the beam, R(alpha), with the axes of the base at the laser's place.
struct RangeScan {
  double first_rad = 0.0;        ///< direction of beam 0
  double increment_rad = 0.0;    ///< between two beams; negative where they turn clockwise, seen from above
  std::vector<double> ranges_m;  ///< NaN where there is none

  std::size_t size() const { return ranges_m.size(); }
  double direction_rad(std::size_t beam) const {
    return first_rad + static_cast<double>(beam) * increment_rad;
  }
  Eigen::Vector2d point(std::size_t beam) const;
  /// The same beams.
  bool comparable(const RangeScan& other) const;
};

RangeScan rangeScanOf(const LaserScan& scan, const Eigen::Isometry3d& T_base_laser);

/// The scan, and then levels of half as many beams each, smoothed over five of which those count that lie on
/// the same surface: at most five levels, none but the first with fewer than 20 beams.
std::vector<RangeScan> rangePyramid(const RangeScan& scan);

/// The scan as the laser would have measured it `there`, with its points moved: the beams cut the surfaces
/// between neighbours, and the nearest cut counts.
RangeScan warped(const RangeScan& scan, const Eigen::Isometry2d& T_there_here);

}  // namespace stereo_nav::odometry
