#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace stereo_nav::navigation {

/// A pose in the frame of the map.
struct PlanarPose {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
};

enum class PlanStatus {
  kFound,
  kGoalMoved,     ///< the goal was not free; the path ends at the nearest point that is, within the tolerance
  kOutside,       ///< start or goal is not on the map
  kStartBlocked,  ///< the robot stands where nothing leads out
  kGoalBlocked,   ///< the goal is not free, and no free point is within the tolerance
  kNoWay,         ///< start and goal are free, but nothing connects them
};

/// A path, or why there is none.
struct Plan {
  PlanStatus status = PlanStatus::kNoWay;
  /// Straight ways from one pose to the next; the robot turns at each to the heading of the next. Empty: no
  /// path.
  std::vector<PlanarPose> poses;
  double length_m = 0.0;
  double cost_m = 0.0;       ///< length plus what the clearance costs
  double clearance_m = 0.0;  ///< the least between the outline and an obstacle, to the grid's resolution
  double left_m = 0.0;       ///< so far the path leads out of obstacles that the robot touches at the start
  std::string text;          ///< one or two sentences for people

  bool found() const { return !poses.empty(); }
};

}  // namespace stereo_nav::navigation
