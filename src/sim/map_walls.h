#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "grid/occupancy_grid.h"
#include "sim/scene.h"

namespace stereo_nav::sim {

/// A world whose walls are the occupied cells of a map.
struct MapWallsParams {
  std::string file;  ///< YAML file of map_server's format; empty: there are no such walls
  double height_m = 1.5;
  Material material{TextureKind::kClutter, 0.5, 0.7, 2.0};

  void describe(ParameterVisitor& visitor);
};

/// Rectangles of cells that together cover exactly the obstacles of a mask, few of them: runs of a row that
/// go on in the rows that follow.
std::vector<cv::Rect> rectanglesOf(const cv::Mat_<std::uint8_t>& mask);

/// Raises a box on each rectangle of occupied cells, and widens the room to hold the map.
void raiseWalls(const grid::OccupancyGrid& map, const MapWallsParams& params, SceneParams& scene);

}  // namespace stereo_nav::sim
