#pragma once

#include <nav_msgs/OccupancyGrid.h>

#include <string>

#include "grid/occupancy_grid.h"

namespace stereo_nav::ros_io {

/// Writes the grid into a message, whose memory is used again.
void fillMessage(const grid::OccupancyGrid& grid, const std::string& frame, const ros::Time& stamp,
                 nav_msgs::OccupancyGrid& message);

/// The grid of a message. Throws InputError where the number of cells does not fit its width and height, its
/// resolution is not above zero, or its origin is not in the plane.
grid::OccupancyGrid toGrid(const nav_msgs::OccupancyGrid& message);

}  // namespace stereo_nav::ros_io
