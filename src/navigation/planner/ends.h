#pragma once

#include <cstdint>
#include <vector>

#include "navigation/planner/robot_space.h"

namespace stereo_nav::navigation {

/// The cells by which a robot that touches obstacles gets away from them: from its cell on always to the
/// neighbour that is farthest from obstacles, up to the first one where it fits and can go on. At most `most`
/// steps. Only the start itself: it fits there. Empty: that way ends in a dead end, or is longer.
std::vector<grid::Cell> wayOutOfObstacles(const RobotSpace& space, grid::Cell start, int most);

/// All cells that can be reached from a cell by the moves of the space, 1 for each; it knows nothing of
/// turning.
cv::Mat_<std::uint8_t> reachableFrom(const MoveGrid& grid, grid::Cell start);

/// Of the cells marked in `reachable` the one whose centre is nearest to a place in cells. At least one must
/// be marked.
grid::Cell nearestCell(const cv::Mat_<std::uint8_t>& reachable, const Eigen::Vector2d& place);

/// The moves that a robot can begin with at a cell: those to whose heading it can turn.
std::uint8_t firstMoves(const RobotSpace& space, grid::Cell cell, double heading_rad);

}  // namespace stereo_nav::navigation
