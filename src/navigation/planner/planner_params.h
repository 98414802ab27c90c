#pragma once

#include "grid/clearance_cost.h"
#include "grid/occupancy_grid.h"
#include "navigation/planner/robot_space.h"
#include "navigation/planner/search_params.h"

namespace stereo_nav::navigation {

/// Parameters of path planning: config/planner.yaml.
struct PlannerParams {
  double footprint_length_m = 0.5;
  double footprint_width_m = 0.4;
  /// Corners "x y, x y, ..." in base_link, m; they replace length and width.
  std::string footprint;
  HeadingRule heading = HeadingRule::kTravel;
  grid::UnknownSpace unknown = grid::UnknownSpace::kAsObstacle;
  grid::ClearanceParams clearance;
  SearchParams search;
  double goal_tolerance_m = 0.25;
  double leave_within_m = 0.5;
  double shortcut_slack = 0.03;
  double better_by = 0.15;

  void describe(ParameterVisitor& visitor);
  /// Throws InputError.
  grid::Footprint makeFootprint() const;
};

}  // namespace stereo_nav::navigation
