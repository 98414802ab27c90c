#include "estimation/range_correction/seen_walls.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "grid/ray_cast.h"

namespace stereo_nav::estimation {
namespace {

constexpr double kRayStep_rad = 0.5 * kPi / 180.0;
constexpr double kFan_rad = 10.0 * kPi / 180.0;  ///< to each side: enough of a wall for its direction
constexpr std::size_t kFewestHits = 4;
constexpr double kCorner_cells = 1.2;  ///< hits that lie farther from a line are no steps of one wall

struct Hit {
  Eigen::Vector2d p;
  double off_rad;  ///< from the beam's middle
};
using Hits = std::vector<Hit>;
using Part = std::pair<std::size_t, std::size_t>;  ///< first hit, and the one behind the last

Eigen::Vector2d unit(double direction_rad) {
  return {std::cos(direction_rad), std::sin(direction_rad)};
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Splits hits at the one farthest from the line between the ends, until all are near.
void splitAtCorners(const Hits& hits, Part part, double tolerance_m, std::vector<Part>& parts) {
  if (part.second - part.first < kFewestHits) return;
  const Eigen::Vector2d& begin = hits[part.first].p;
  const Eigen::Vector2d along = (hits[part.second - 1].p - begin).normalized();
  std::size_t farthest = part.first;
  double distance_m = 0.0;
  for (std::size_t i = part.first; i < part.second; ++i) {
    const double own_m = std::abs(cross(along, hits[i].p - begin));
    if (own_m > distance_m) {
      distance_m = own_m;
      farthest = i;
    }
  }
  if (distance_m <= tolerance_m) {
    parts.push_back(part);
    return;
  }
  splitAtCorners(hits, {part.first, farthest + 1}, tolerance_m, parts);
  splitAtCorners(hits, {farthest, part.second}, tolerance_m, parts);
}

/// Whether a wall may go on from one hit to the next: seen at up to 80 degrees from its normal.
bool goesOn(const Hit& a, const Hit& b, const Eigen::Vector2d& from, double resolution_m) {
  const double widest_m = 6.0 * kRayStep_rad * std::min((a.p - from).norm(), (b.p - from).norm());
  return (a.p - b.p).norm() <= widest_m + 1.5 * resolution_m;
}

SeenWall fitted(const Hits& hits, Part part, const Eigen::Vector2d& from) {
  const double n = static_cast<double>(part.second - part.first);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i = part.first; i < part.second; ++i) mean += hits[i].p / n;
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (std::size_t i = part.first; i < part.second; ++i)
    scatter += (hits[i].p - mean) * (hits[i].p - mean).transpose() / n;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(scatter);
  SeenWall wall;
  wall.normal = solver.eigenvectors().col(0);
  if (wall.normal.dot(mean - from) < 0.0) wall.normal = -wall.normal;
  wall.offset_m = wall.normal.dot(mean);
  wall.sigma_m = std::sqrt(std::max(0.0, solver.eigenvalues()[0]));
  return wall;
}

}  // namespace

std::vector<SeenWall> wallsOf(const grid::OccupancyGrid& map, const Beam& beam, double direction_sigma_rad,
                              double range_m) {
  const double reach_rad =
      std::min(beam.half_width_rad + 2.0 * direction_sigma_rad + 0.5 * kRayStep_rad, 0.5 * kPi);
  const int side = static_cast<int>(std::ceil((reach_rad + kFan_rad) / kRayStep_rad));
  Hits hits;
  std::vector<Part> walls;
  const double resolution_m = map.geometry.resolution_m;
  std::size_t begin = 0;
  const auto endWall = [&](std::size_t end) {
    splitAtCorners(hits, {begin, end}, kCorner_cells * resolution_m, walls);
    begin = end;
  };
  for (int i = side; i >= -side; --i) {
    const double direction_rad = beam.direction_rad + i * kRayStep_rad;
    const grid::RayHit hit = grid::castRay(map, beam.p_map, direction_rad, range_m);
    if (!hit.hit) {
      endWall(hits.size());
      continue;
    }
    hits.push_back({beam.p_map + hit.distance_m * unit(direction_rad), i * kRayStep_rad});
    const std::size_t n = hits.size();
    if (n > begin + 1 && !goesOn(hits[n - 2], hits[n - 1], beam.p_map, resolution_m)) endWall(n - 1);
  }
  endWall(hits.size());
  std::vector<SeenWall> seen;
  for (const Part& part : walls) {
    const auto meant = [&](const Hit& hit) { return std::abs(hit.off_rad) <= reach_rad; };
    if (std::any_of(hits.begin() + static_cast<std::ptrdiff_t>(part.first),
                    hits.begin() + static_cast<std::ptrdiff_t>(part.second), meant))
      seen.push_back(fitted(hits, part, beam.p_map));
  }
  return seen;
}

ExpectedRange expectedRange(const SeenWall& wall, const Beam& beam) {
  double direction_rad = beam.direction_rad;
  const double to_normal_rad = wrapRadians(std::atan2(wall.normal.y(), wall.normal.x()) - beam.direction_rad);
  const double to_nearest_rad = std::clamp(to_normal_rad, -beam.half_width_rad, beam.half_width_rad);
  if (beam.nearest) direction_rad += to_nearest_rad;
  const Eigen::Vector2d direction = unit(direction_rad);
  const double distance_m = wall.offset_m - wall.normal.dot(beam.p_map);
  ExpectedRange expected;
  expected.incidence = wall.normal.dot(direction);
  expected.range_m = distance_m / expected.incidence;
  if (!beam.nearest)
    expected.across_m = expected.range_m - distance_m / std::cos(to_normal_rad - to_nearest_rad);
  expected.by_position = -wall.normal / expected.incidence;
  expected.by_direction_m_rad = -expected.range_m * cross(direction, wall.normal) / expected.incidence;
  return expected;
}

}  // namespace stereo_nav::estimation
