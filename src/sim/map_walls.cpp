#include "sim/map_walls.h"

#include <algorithm>

#include "core/angles.h"

namespace stereo_nav::sim {
namespace {

/// End of the run of obstacles that begins at a column.
int endOfRun(const cv::Mat_<std::uint8_t>& mask, int row, int column) {
  while (column < mask.cols && mask(row, column) != 0) ++column;
  return column;
}

}  // namespace

void MapWallsParams::describe(ParameterVisitor& visitor) {
  visitor.text("file", file,
               "map (YAML of map_server), beside the scenario: its occupied cells become walls");
  visitor.real("height_m", height_m, {0.01, 100.0}, "m", "of these walls");
  visitSection(visitor, "material", material);
}

std::vector<cv::Rect> rectanglesOf(const cv::Mat_<std::uint8_t>& mask) {
  cv::Mat_<std::uint8_t> rest = mask.clone();
  std::vector<cv::Rect> rectangles;
  for (int row = 0; row < rest.rows; ++row) {
    for (int column = 0; column < rest.cols; ++column) {
      if (rest(row, column) == 0) continue;
      cv::Rect run(column, row, endOfRun(rest, row, column) - column, 1);
      const auto goes_on = [&](int next) {
        return next < rest.rows && endOfRun(rest, next, run.x) >= run.x + run.width;
      };
      while (goes_on(run.y + run.height)) ++run.height;
      rest(run) = 0;
      rectangles.push_back(run);
    }
  }
  return rectangles;
}

void raiseWalls(const grid::OccupancyGrid& map, const MapWallsParams& params, SceneParams& scene) {
  const grid::GridGeometry& geometry = map.geometry;
  ObjectParams wall;
  wall.name = "wall of the map";
  wall.height_m = params.height_m;
  wall.yaw_deg = geometry.origin_yaw_rad / kRadPerDeg;
  wall.material = params.material;
  for (const cv::Rect& cells : rectanglesOf(grid::obstacleMask(map, grid::UnknownSpace::kAsFree))) {
    const Eigen::Vector2d middle =
        geometry.fromCells({cells.x + 0.5 * cells.width, cells.y + 0.5 * cells.height});
    wall.x_m = middle.x();
    wall.y_m = middle.y();
    wall.length_m = cells.width * geometry.resolution_m;
    wall.width_m = cells.height * geometry.resolution_m;
    scene.objects.push_back(wall);
  }
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
    const Eigen::Vector2d corner =
        geometry.fromCells(Eigen::Vector2d(x * geometry.width, y * geometry.height));
    scene.room.x_min_m = std::min(scene.room.x_min_m, corner.x());
    scene.room.x_max_m = std::max(scene.room.x_max_m, corner.x());
    scene.room.y_min_m = std::min(scene.room.y_min_m, corner.y());
    scene.room.y_max_m = std::max(scene.room.y_max_m, corner.y());
  }
}

}  // namespace stereo_nav::sim
