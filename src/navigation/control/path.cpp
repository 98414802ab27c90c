#include "navigation/control/path.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::control {
namespace {

constexpr double kPiece_m = 0.02;
constexpr double kWindow_m = 0.05;
constexpr double kLeastWindow_m = 0.01;  ///< at the ends of the path, where the window has one side
constexpr double kSamePlace_m = 1e-6;

void append(const Eigen::Vector2d& position, std::vector<PathPoint>& points) {
  if (!position.allFinite()) throw InputError("the path has a point that is not finite");
  if (points.empty()) {
    points.push_back({position, 0.0, 0.0, 0.0});
    return;
  }
  const PathPoint start = points.back();
  const double length_m = (position - start.position).norm();
  if (length_m < kSamePlace_m) return;
  const int pieces = static_cast<int>(std::ceil(length_m / kPiece_m));
  for (int i = 1; i <= pieces; ++i) {
    const double share = static_cast<double>(i) / pieces;
    points.push_back(
        {start.position + share * (position - start.position), start.arc_m + share * length_m, 0.0, 0.0});
  }
}

}  // namespace

Path::Path(const std::vector<Eigen::Vector2d>& points) {
  for (const auto& position : points) append(position, points_);
  if (points_.size() < 2)
    throw InputError(
        "the path has fewer than two different points; it leads nowhere: give one from start to goal");
  addHeadings();
  addCurvatures();
}

void Path::addHeadings() {
  for (auto& point : points_) {
    const double half_m =
        std::max(kLeastWindow_m, std::min({kWindow_m, point.arc_m, length_m() - point.arc_m}));
    const Eigen::Vector2d chord = positionAt(point.arc_m + half_m) - positionAt(point.arc_m - half_m);
    point.heading_rad = std::atan2(chord.y(), chord.x());
  }
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const double before_rad = points_[i - 1].heading_rad;
    points_[i].heading_rad = before_rad + wrapRadians(points_[i].heading_rad - before_rad);
  }
}

void Path::addCurvatures() {
  std::vector<double> curvatures;
  for (const auto& point : points_) {
    const double from_m = std::max(0.0, point.arc_m - kWindow_m);
    const double to_m = std::min(length_m(), point.arc_m + kWindow_m);
    curvatures.push_back((at(to_m).heading_rad - at(from_m).heading_rad) / (to_m - from_m));
  }
  for (std::size_t i = 0; i < points_.size(); ++i) points_[i].curvature_per_m = curvatures[i];
}

std::size_t Path::segmentAt(double arc_m) const {
  const auto after = std::upper_bound(points_.begin() + 1, points_.end() - 1, arc_m,
                                      [](double arc, const PathPoint& point) { return arc < point.arc_m; });
  return static_cast<std::size_t>(after - points_.begin()) - 1;
}

Eigen::Vector2d Path::positionAt(double arc_m) const {
  const std::size_t i = segmentAt(arc_m);
  const double share =
      std::clamp((arc_m - points_[i].arc_m) / (points_[i + 1].arc_m - points_[i].arc_m), 0.0, 1.0);
  return points_[i].position + share * (points_[i + 1].position - points_[i].position);
}

PathPoint Path::at(double arc_m) const {
  arc_m = std::clamp(arc_m, 0.0, length_m());
  const std::size_t i = segmentAt(arc_m);
  const PathPoint &a = points_[i], &b = points_[i + 1];
  const double share = (arc_m - a.arc_m) / (b.arc_m - a.arc_m);
  return {a.position + share * (b.position - a.position), arc_m,
          a.heading_rad + share * (b.heading_rad - a.heading_rad),
          a.curvature_per_m + share * (b.curvature_per_m - a.curvature_per_m)};
}

double Path::nearestArc(const Eigen::Vector2d& position, double from_m, double to_m) const {
  from_m = std::clamp(from_m, 0.0, length_m());
  to_m = std::clamp(to_m, from_m, length_m());
  double best_m = from_m, best_squared = (positionAt(from_m) - position).squaredNorm();
  for (std::size_t i = segmentAt(from_m); i + 1 < points_.size() && points_[i].arc_m <= to_m; ++i) {
    const Eigen::Vector2d along = points_[i + 1].position - points_[i].position;
    const double share = along.dot(position - points_[i].position) / along.squaredNorm();
    const double arc_m = std::clamp(points_[i].arc_m + share * along.norm(),
                                    std::max(from_m, points_[i].arc_m), std::min(to_m, points_[i + 1].arc_m));
    const double squared = (positionAt(arc_m) - position).squaredNorm();
    if (squared < best_squared) {
      best_squared = squared;
      best_m = arc_m;
    }
  }
  return best_m;
}

double Path::leftOf(const Eigen::Vector2d& position, double arc_m) const {
  const PathPoint point = at(arc_m);
  const Eigen::Vector2d normal(-std::sin(point.heading_rad), std::cos(point.heading_rad));
  return normal.dot(position - point.position);
}

}  // namespace stereo_nav::control
