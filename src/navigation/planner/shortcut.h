#pragma once

#include <vector>

#include "navigation/planner/robot_space.h"

namespace stereo_nav::navigation {

/// A path through points in cells, in the axes of the grid.
using CellPath = std::vector<Eigen::Vector2d>;

/// The same way with only the points at which it bends.
CellPath bendsOf(const CellPath& path);

/// Replaces points by straight ways, from the start on each as far as it goes, as long as that changes
/// anything. A straight way must leave the outline of the robot free, in every place and where it turns at
/// both ends, and must not cost more than what it replaces by more than the share `slack`: it never buys
/// length with clearance that the search had paid for.
CellPath shortened(const RobotSpace& space, const CellPath& path, double slack);

/// Every n-th point, and the last: how the published work thins its paths. It looks at no obstacle, and cuts
/// corners: with n = 20 a clearance of 335 mm became 235 mm there, with n = 40 none. For comparison only.
CellPath thinnedAsPublished(const CellPath& path, int n);

}  // namespace stereo_nav::navigation
