#include "grid/footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angles.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::grid {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Corners of a turning robot are followed at least every so far.
constexpr double kTurnStep_rad = 2.0 * kRadPerDeg;

}  // namespace

/// Andrew's monotone chain (1979).
Polygon convexHull(Polygon points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  Polygon hull;
  const auto add_chain = [&hull](auto first, auto last) {
    const std::size_t start = hull.size();
    for (auto point = first; point != last; ++point) {
      while (hull.size() >= start + 2 &&
             cross(hull.back() - hull[hull.size() - 2], *point - hull.back()) <= 1e-12)
        hull.pop_back();
      hull.push_back(*point);
    }
    hull.pop_back();  // it begins the other chain
  };
  if (points.size() < 2) return points;
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

Footprint::Footprint(const Polygon& corners_m) : corners_(convexHull(corners_m)) {
  for (const auto& corner : corners_m)
    if (!corner.allFinite()) throw InputError("a corner of the footprint is not a number");
  if (corners_.size() < 3)
    throw InputError(
        "the footprint needs at least three corners that are not on one line, e.g. [[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]]");
  inscribed_m_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Eigen::Vector2d side = corners_[(i + 1) % corners_.size()] - corners_[i];
    inscribed_m_ = std::min(inscribed_m_, cross(side, -corners_[i]) / side.norm());
    circumscribed_m_ = std::max(circumscribed_m_, corners_[i].norm());
  }
  if (inscribed_m_ <= 0.0)
    throw InputError(
        "the footprint does not hold the origin of base_link, about which the robot turns; its corners are in m, in base_link");
}

Footprint Footprint::rectangle(double length_m, double width_m) {
  const double x = length_m / 2.0, y = width_m / 2.0;
  return Footprint({{x, y}, {-x, y}, {-x, -y}, {x, -y}});
}

Polygon Footprint::at(const Eigen::Vector2d& position, double heading_rad) const {
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  Polygon placed;
  for (const auto& corner : corners_)
    placed.emplace_back(position.x() + c * corner.x() - s * corner.y(),
                        position.y() + s * corner.x() + c * corner.y());
  return placed;
}

Polygon Footprint::sweptBy(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double heading_rad) const {
  Polygon corners = at(from, heading_rad);
  const Polygon end = at(to, heading_rad);
  corners.insert(corners.end(), end.begin(), end.end());
  return convexHull(corners);
}

Polygon Footprint::turning(const Eigen::Vector2d& position, double from_rad, double to_rad) const {
  const double turn_rad = wrapRadians(to_rad - from_rad);
  const int steps = std::max(1, static_cast<int>(std::ceil(std::fabs(turn_rad) / kTurnStep_rad)));
  const double half_step_rad = turn_rad / steps / 2.0;
  Polygon corners;
  for (int i = 0; i <= steps; ++i) {
    // A little larger, so that the chords between the steps hold the arcs.
    for (const auto& corner : at(Eigen::Vector2d::Zero(), from_rad + turn_rad * i / steps))
      corners.emplace_back(position + corner / std::cos(half_step_rad));
  }
  return convexHull(corners);
}

}  // namespace stereo_nav::grid
