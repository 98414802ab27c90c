#include "odometry/laser/laser_scan.h"

#include <cmath>

namespace stereo_nav::odometry {

LaserPoints pointsOf(const LaserScan& scan, const Eigen::Isometry3d& T_base_laser) {
  LaserPoints result;
  result.points.reserve(scan.ranges_m.size());
  const Eigen::Matrix2d in_plane = T_base_laser.linear().topLeftCorner<2, 2>();
  const Eigen::Vector2d origin = T_base_laser.translation().head<2>();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = static_cast<double>(scan.ranges_m[i]);
    if (std::isnan(range_m)) {
      ++result.invalid;
      continue;
    }
    if (!(range_m >= scan.range_min_m && range_m <= scan.range_max_m) || range_m <= 0.0) {
      ++result.without_return;
      continue;
    }
    const auto beam = static_cast<double>(i);
    const double angle_rad = scan.angle_min_rad + beam * scan.angle_increment_rad;
    const Eigen::Vector2d direction = in_plane * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
    result.points.push_back({origin + range_m * direction, direction, range_m, beam * scan.time_increment_s});
  }
  return result;
}

}  // namespace stereo_nav::odometry
