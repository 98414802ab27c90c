#pragma once

#include "grid/occupancy_grid.h"
#include "sim/scene.h"

namespace stereo_nav::sim {

/// What stands in a room at a height above the floor, in cells of 2 cm, in the frame of the world. Who walks,
/// and what comes later, is not in the map.
grid::OccupancyGrid wallMap(const Scene& scene, const RoomParams& room, double height_m);

}  // namespace stereo_nav::sim
