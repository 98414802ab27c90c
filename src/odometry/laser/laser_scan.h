#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

namespace stereo_nav::odometry {

/// One sweep of a planar laser, as sensor_msgs/LaserScan has it.
struct LaserScan {
  double time_s = 0.0;               ///< of the first beam
  double angle_min_rad = 0.0;        ///< of the first beam, about z of the laser
  double angle_increment_rad = 0.0;  ///< negative where the beam turns clockwise
  double time_increment_s = 0.0;     ///< between two beams; 0: all are taken at once
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges_m;  ///< REP-117: -inf too close, +inf no return, NaN invalid

  double sweep_s() const {
    return ranges_m.empty() ? 0.0 : time_increment_s * static_cast<double>(ranges_m.size() - 1);
  }
};

/// One return of the laser.
struct LaserPoint {
  Eigen::Vector2d p_base;          ///< seen from the base as it was when the beam was taken, m
  Eigen::Vector2d direction_base;  ///< of the beam
  double range_m = 0.0;
  double after_s = 0.0;  ///< time of the beam after the scan's stamp
};

/// The returns of a scan, and what became of the beams without one.
struct LaserPoints {
  std::vector<LaserPoint> points;
  std::size_t without_return = 0;  ///< +inf, -inf, or outside of the range that the scan states
  std::size_t invalid = 0;         ///< NaN
};

/// The returns in the plane of the base. `T_base_laser` may turn the laser upside down: a beam's direction is
/// that of its point seen from above.
LaserPoints pointsOf(const LaserScan& scan, const Eigen::Isometry3d& T_base_laser);

}  // namespace stereo_nav::odometry
