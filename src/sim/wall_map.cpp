#include "sim/wall_map.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::sim {
namespace {

constexpr double kCell_m = 0.02;
constexpr double kMargin_m = 0.1;  ///< behind the room's walls

bool holds(const Solid& solid, const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d p = (solid.R_solid_world * (p_world - solid.p_world)).cwiseAbs();
  const Eigen::Vector3d half = solid.half.cast<double>();
  if (p.z() > half.z()) return false;
  if (solid.kind == Solid::Kind::kCylinder) return p.head<2>().norm() <= half.x();
  return p.x() <= half.x() && p.y() <= half.y();
}

bool isWall(const Solid& solid, const Eigen::Vector3d& p_world) {
  if (solid.kind == Solid::Kind::kRoom) return !holds(solid, p_world);
  return solid.walk_m.isZero() && solid.isThere(0.0) && holds(solid, p_world);
}

}  // namespace

grid::OccupancyGrid wallMap(const Scene& scene, const RoomParams& room, double height_m) {
  grid::GridGeometry geometry;
  geometry.resolution_m = kCell_m;
  geometry.origin_x_m = room.x_min_m - kMargin_m;
  geometry.origin_y_m = room.y_min_m - kMargin_m;
  geometry.width = static_cast<int>(std::ceil((room.x_max_m - room.x_min_m + 2.0 * kMargin_m) / kCell_m));
  geometry.height = static_cast<int>(std::ceil((room.y_max_m - room.y_min_m + 2.0 * kMargin_m) / kCell_m));
  grid::OccupancyGrid map(geometry, grid::kFree);
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const Eigen::Vector2d centre = geometry.centreOf({x, y});
      const Eigen::Vector3d p(centre.x(), centre.y(), height_m);
      if (std::any_of(scene.solids().begin(), scene.solids().end(),
                      [&p](const Solid& solid) { return isWall(solid, p); }))
        map.at({x, y}) = grid::kOccupied;
    }
  }
  return map;
}

}  // namespace stereo_nav::sim
