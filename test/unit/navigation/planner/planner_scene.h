#pragma once

#include <algorithm>

#include "core/angles.h"
#include "grid/occupancy_grid.h"
#include "navigation/planner/path_planner.h"

namespace stereo_nav::navigation {

/// A free map with its lower left corner at the origin.
inline grid::OccupancyGrid freeMap(double width_m, double height_m, double resolution_m = 0.025) {
  grid::GridGeometry geometry;
  geometry.resolution_m = resolution_m;
  geometry.width = static_cast<int>(std::lround(width_m / resolution_m));
  geometry.height = static_cast<int>(std::lround(height_m / resolution_m));
  return grid::OccupancyGrid(geometry, grid::kFree);
}

/// Sets the cells of a box (m) and returns them.
inline cv::Rect setBox(grid::OccupancyGrid& map, double x0, double y0, double x1, double y1,
                       std::int8_t value = grid::kOccupied) {
  const double r = map.geometry.resolution_m;
  const cv::Rect box(cv::Point(static_cast<int>(std::lround(x0 / r)), static_cast<int>(std::lround(y0 / r))),
                     cv::Point(static_cast<int>(std::lround(x1 / r)), static_cast<int>(std::lround(y1 / r))));
  for (int y = box.y; y < box.br().y; ++y)
    for (int x = box.x; x < box.br().x; ++x) map.at({x, y}) = value;
  return box;
}

/// The field of the published work, 6 x 11.4 m, with two fences and two boxes; its start is (0.55, 0.35) and
/// its goal (4.3, 10.0).
inline grid::OccupancyGrid contestField() {
  grid::OccupancyGrid map = freeMap(6.0, 11.4);
  setBox(map, 0.0, 4.0, 4.5, 4.05);
  setBox(map, 1.5, 7.6, 6.0, 7.65);
  setBox(map, 2.4, 5.4, 3.2, 6.2);
  setBox(map, 2.0, 2.0, 2.4, 2.4);
  return map;
}

/// The robot of the published work: 650 x 650 mm, on swerve modules.
inline PlannerParams contestRobot() {
  PlannerParams params;
  params.footprint_length_m = params.footprint_width_m = 0.65;
  params.heading = HeadingRule::kKept;
  return params;
}

/// Whether a robot that drives along a path touches an obstacle, by looking at each of its places against
/// each obstacle cell: the least distance in m between its outline and the squares of the obstacles (a little
/// more than that, since places are 5 mm apart).
inline double leastDistance(const grid::OccupancyGrid& map, const grid::Footprint& robot,
                            const std::vector<PlanarPose>& poses, HeadingRule rule) {
  std::vector<Eigen::Vector2d> obstacles;
  for (int y = 0; y < map.geometry.height; ++y)
    for (int x = 0; x < map.geometry.width; ++x)
      if (map.at({x, y}) != grid::kFree) obstacles.push_back(map.geometry.centreOf({x, y}));
  double least = 1e9;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Eigen::Vector2d way = poses[i].position_m - poses[i - 1].position_m;
    const double heading = rule == HeadingRule::kKept ? poses[0].heading_rad : std::atan2(way.y(), way.x());
    const int samples = static_cast<int>(way.norm() / 0.005) + 1;
    for (int s = 0; s <= samples; ++s) {
      const Eigen::Vector2d at = poses[i - 1].position_m + way * s / samples;
      const grid::Polygon outline = robot.at(at, heading);
      for (const auto& obstacle : obstacles) {
        if ((obstacle - at).norm() > robot.circumscribedRadius() + 0.1) continue;
        const double half = 0.5 * map.geometry.resolution_m;
        double left = 1e9, right = -1e9, low = 1e9, high = -1e9;
        for (const auto& corner : outline) {
          left = std::min(left, corner.x());
          right = std::max(right, corner.x());
          low = std::min(low, corner.y());
          high = std::max(high, corner.y());
        }
        // The distance along the axis that separates them most: sides of the square, then of the outline.
        double distance = std::max({left - obstacle.x() - half, obstacle.x() - half - right,
                                    low - obstacle.y() - half, obstacle.y() - half - high});
        for (std::size_t c = 0; c < outline.size(); ++c) {
          const Eigen::Vector2d side = (outline[(c + 1) % outline.size()] - outline[c]).normalized();
          const Eigen::Vector2d out(side.y(), -side.x());
          const double half_cell =
              0.5 * map.geometry.resolution_m * (std::fabs(out.x()) + std::fabs(out.y()));
          distance = std::max(distance, (obstacle - outline[c]).dot(out) - half_cell);
        }
        least = std::min(least, distance);
      }
    }
  }
  return least;
}

}  // namespace stereo_nav::navigation
