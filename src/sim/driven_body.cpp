#include "sim/driven_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angles.h"
#include "core/planar_motion.h"

namespace stereo_nav::sim {
namespace {

using grid::Polygon;

constexpr double kTouch_m = 1e-3;
constexpr int kCorners = 48;  ///< of the polygon that stands for a circle

/// Distance of two outlines, negative where they overlap, and the direction from the first to the second.
struct Gap {
  double distance_m = -std::numeric_limits<double>::infinity();
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
};

/// Takes the gap across the sides of `a` if it is wider.
void widen(const Polygon& a, const Polygon& b, double sign, Gap& gap) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Eigen::Vector2d side = a[(i + 1) % a.size()] - a[i];
    const Eigen::Vector2d outwards = Eigen::Vector2d(side.y(), -side.x()).normalized();
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& corner : b) nearest = std::min(nearest, outwards.dot(corner - a[i]));
    if (nearest > gap.distance_m) gap = {nearest, sign * outwards};
  }
}

/// By the separating axis of two convex polygons: exact where they overlap, else at most the distance.
Gap gapBetween(const Polygon& a, const Polygon& b) {
  Gap gap;
  widen(a, b, 1.0, gap);
  widen(b, a, -1.0, gap);
  return gap;
}

Polygon outlineOf(const Solid& solid, double time_s) {
  const Eigen::Matrix2d R_world_solid = solid.R_solid_world.topLeftCorner<2, 2>().transpose();
  const Eigen::Vector2d middle = solid.position(time_s).head<2>();
  const Eigen::Vector2d half = solid.half.head<2>().cast<double>();
  Polygon outline;
  if (solid.kind == Solid::Kind::kCylinder) {
    for (int i = 0; i < kCorners; ++i) {
      const double angle_rad = 2.0 * kPi * i / kCorners;
      outline.push_back(middle + half.x() * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
    }
    return outline;
  }
  for (const auto& [x, y] : {std::pair(1, 1), std::pair(-1, 1), std::pair(-1, -1), std::pair(1, -1)})
    outline.push_back(middle + R_world_solid * Eigen::Vector2d(x * half.x(), y * half.y()));
  return outline;
}

/// From an outline inside the room to its nearest wall.
Gap gapToWalls(const Polygon& outline, const Solid& room) {
  Gap gap{std::numeric_limits<double>::infinity(), Eigen::Vector2d::UnitX()};
  for (const auto& corner : outline) {
    const Eigen::Vector2d p = corner - room.p_world.head<2>();
    for (int axis = 0; axis < 2; ++axis) {
      const double distance_m = static_cast<double>(room.half[axis]) - std::abs(p[axis]);
      if (distance_m < gap.distance_m)
        gap = {distance_m, Eigen::Vector2d::Unit(axis) * std::copysign(1.0, p[axis])};
    }
  }
  return gap;
}

Gap gapTo(const Polygon& outline, const Solid& solid, double time_s) {
  if (solid.kind == Solid::Kind::kRoom) return gapToWalls(outline, solid);
  return gapBetween(outline, outlineOf(solid, time_s));
}

bool isNear(const Eigen::Vector2d& p, double radius_m, const Solid& solid, double time_s) {
  if (solid.kind == Solid::Kind::kRoom) return true;
  const double reach_m = radius_m + static_cast<double>(solid.half.head<2>().norm());
  return (solid.position(time_s).head<2>() - p).squaredNorm() < reach_m * reach_m;
}

}  // namespace

DrivenBody::DrivenBody(const DrivenParams& params)
    : params_(params), footprint_(grid::Footprint::rectangle(params.length_m, params.width_m)) {}

bool DrivenBody::concerns(const Solid& solid, double time_s) const {
  if (!solid.isThere(time_s)) return false;
  if (solid.kind == Solid::Kind::kRoom) return true;
  const double half_m = static_cast<double>(solid.half.z());
  return solid.p_world.z() + half_m > params_.clearance_m && solid.p_world.z() - half_m < params_.height_m;
}

bool DrivenBody::tryMotion(Scene& scene, const Eigen::Isometry2d& T_before, const Eigen::Isometry2d& T_after,
                           double time_s) {
  const Polygon after = footprint_.at(T_after.translation(), yawOf(T_after));
  const Polygon before = footprint_.at(T_before.translation(), yawOf(T_before));
  touched_.clear();
  bool is_free = true;
  for (std::size_t i = 0; i < scene.solids().size(); ++i) {
    const Solid& solid = scene.solids()[i];
    if (!isNear(T_after.translation(), footprint_.circumscribedRadius() + kTouch_m, solid, time_s) ||
        !concerns(solid, time_s))
      continue;
    const Gap gap = gapTo(after, solid, time_s);
    if (gap.distance_m > kTouch_m) continue;
    touched_.push_back(i);
    if (gap.distance_m >= 0.0 || gap.distance_m >= gapTo(before, solid, time_s).distance_m) continue;
    is_free = (solid.movable && tryPush(scene, i, -gap.distance_m * gap.normal, time_s)) && is_free;
  }
  return is_free;
}

void DrivenBody::holdWalkers(Scene& scene, const Eigen::Isometry2d& T_world_base, double time_s,
                             double step_s) const {
  const Polygon outline = footprint_.at(T_world_base.translation(), yawOf(T_world_base));
  for (std::size_t i = 0; i < scene.solids().size(); ++i) {
    const Solid& solid = scene.solids()[i];
    if (solid.waits_m == 0.0 || solid.walk_m.isZero() || !concerns(solid, time_s)) continue;
    const double next_m = gapTo(outline, solid, time_s + step_s).distance_m;
    if (next_m < solid.waits_m && next_m < gapTo(outline, solid, time_s).distance_m) scene.hold(i, step_s);
  }
}

bool DrivenBody::tryPush(Scene& scene, std::size_t pushed, const Eigen::Vector2d& way_m,
                         double time_s) const {
  const Solid& solid = scene.solids()[pushed];
  const Polygon before = outlineOf(solid, time_s);
  Polygon after = before;
  for (auto& corner : after) corner += way_m;
  const Eigen::Vector2d middle = solid.position(time_s).head<2>() + way_m;
  for (std::size_t i = 0; i < scene.solids().size(); ++i) {
    const Solid& other = scene.solids()[i];
    if (i == pushed || !isNear(middle, static_cast<double>(solid.half.head<2>().norm()), other, time_s) ||
        !concerns(other, time_s))
      continue;
    const double gap_m = gapTo(after, other, time_s).distance_m;
    if (gap_m < 0.0 && gap_m < gapTo(before, other, time_s).distance_m) return false;
  }
  scene.move(pushed, way_m);
  return true;
}

}  // namespace stereo_nav::sim
