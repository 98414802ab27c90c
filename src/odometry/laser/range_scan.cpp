#include "odometry/laser/range_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/angles.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kNoRange = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostLevels = 5;
constexpr std::size_t kLeastBeams = 20;
/// Ranges that differ by more are not smoothed into one: they lie on different surfaces.
constexpr double kSurface_m = 0.3;
constexpr std::array<double, 5> kBinomial{1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0};
/// Neighbours that lie so many beams apart after a warp are not joined by a surface.
constexpr double kMostStretch = 3.0;

double smoothed(const RangeScan& scan, std::size_t beam) {
  const double centre_m = scan.ranges_m[beam];
  if (std::isnan(centre_m)) return kNoRange;
  double sum_m = 0.0, weights = 0.0;
  for (std::size_t k = 0; k < kBinomial.size(); ++k) {
    if (beam + k < 2 || beam + k - 2 >= scan.size()) continue;
    const double range_m = scan.ranges_m[beam + k - 2];
    const double step = (range_m - centre_m) / kSurface_m;
    if (!(std::abs(step) < 1.0)) continue;
    const double weight = kBinomial[k] * (1.0 - step * step);
    sum_m += weight * range_m;
    weights += weight;
  }
  return sum_m / weights;
}

/// Every second beam, smoothed.
RangeScan halved(const RangeScan& scan) {
  RangeScan result;
  result.first_rad = scan.first_rad;
  result.increment_rad = 2.0 * scan.increment_rad;
  for (std::size_t beam = 0; beam < scan.size(); beam += 2) result.ranges_m.push_back(smoothed(scan, beam));
  return result;
}

/// A point seen by the beams of a scan: which one, between two of them, and how far.
struct Seen {
  double beam = kNoRange;
  double range_m = kNoRange;
};

Seen seenBy(const RangeScan& scan, const Eigen::Vector2d& point) {
  const double middle = 0.5 * static_cast<double>(scan.size() - 1);
  const double middle_rad = scan.first_rad + middle * scan.increment_rad;
  const double off_rad = wrapRadians(std::atan2(point.y(), point.x()) - middle_rad);
  return {middle + off_rad / scan.increment_rad, point.norm()};
}

}  // namespace

Eigen::Vector2d RangeScan::point(std::size_t beam) const {
  const double angle_rad = direction_rad(beam);
  return ranges_m[beam] * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
}

bool RangeScan::comparable(const RangeScan& other) const {
  constexpr double kSame_rad = 1e-4;
  return size() == other.size() && std::abs(first_rad - other.first_rad) < kSame_rad &&
         std::abs(increment_rad - other.increment_rad) * static_cast<double>(size()) < kSame_rad;
}

RangeScan rangeScanOf(const LaserScan& scan, const Eigen::Isometry3d& T_base_laser) {
  RangeScan result;
  const Eigen::Vector3d first = T_base_laser.linear() * Eigen::Vector3d(std::cos(scan.angle_min_rad),
                                                                        std::sin(scan.angle_min_rad), 0.0);
  result.first_rad = std::atan2(first.y(), first.x());
  result.increment_rad = T_base_laser(2, 2) > 0.0 ? scan.angle_increment_rad : -scan.angle_increment_rad;
  result.ranges_m.reserve(scan.ranges_m.size());
  for (const float range : scan.ranges_m) {
    const auto range_m = static_cast<double>(range);
    const bool valid = range_m > 0.0 && range_m >= scan.range_min_m && range_m <= scan.range_max_m;
    result.ranges_m.push_back(valid ? range_m : kNoRange);
  }
  return result;
}

std::vector<RangeScan> rangePyramid(const RangeScan& scan) {
  std::vector<RangeScan> levels{scan};
  while (levels.size() < kMostLevels && levels.back().size() / 2 >= kLeastBeams)
    levels.push_back(halved(levels.back()));
  return levels;
}

RangeScan warped(const RangeScan& scan, const Eigen::Isometry2d& T_there_here) {
  RangeScan result = scan;
  std::fill(result.ranges_m.begin(), result.ranges_m.end(), kNoRange);
  Seen before;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Seen now = std::isnan(scan.ranges_m[i]) ? Seen() : seenBy(scan, T_there_here * scan.point(i));
    const double stretch = now.beam - before.beam;
    if (stretch > 0.0 && stretch < kMostStretch) {
      for (double beam = std::max(0.0, std::ceil(before.beam)); beam <= now.beam; beam += 1.0) {
        const auto k = static_cast<std::size_t>(beam);
        if (k >= result.size()) break;
        const double range_m =
            before.range_m + (beam - before.beam) / stretch * (now.range_m - before.range_m);
        if (!(result.ranges_m[k] <= range_m)) result.ranges_m[k] = range_m;
      }
    }
    before = now;
  }
  return result;
}

}  // namespace stereo_nav::odometry
