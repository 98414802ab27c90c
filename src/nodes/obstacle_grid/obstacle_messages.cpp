#include "nodes/obstacle_grid/obstacle_messages.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::nodes {
namespace {

std::optional<navigation::Beam> beamOf(double direction_rad, double range_m, double range_min_m,
                                       double range_max_m, double free_range_m) {
  navigation::Beam beam;
  beam.direction_rad = direction_rad;
  beam.range_m = range_m;
  beam.hit = range_m >= range_min_m && range_m < range_max_m;
  if (std::isnan(range_m) || range_m < range_min_m) return std::nullopt;
  if (!beam.hit) beam.range_m = std::min(range_max_m, free_range_m);
  return beam;
}

}  // namespace

void toBeams(const sensor_msgs::LaserScan& scan, double free_range_m, std::vector<navigation::Beam>& beams) {
  beams.clear();
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double direction_rad =
        double{scan.angle_min} + static_cast<double>(i) * double{scan.angle_increment};
    const auto beam = beamOf(direction_rad, scan.ranges[i], scan.range_min, scan.range_max, free_range_m);
    if (beam) beams.push_back(*beam);
  }
}

std::optional<navigation::Beam> toBeam(const sensor_msgs::Range& range, double free_range_m) {
  auto beam = beamOf(0.0, range.range, range.min_range, range.max_range, free_range_m);
  if (beam) beam->half_width_rad = 0.5 * double{range.field_of_view};
  return beam;
}

}  // namespace stereo_nav::nodes
