#pragma once

#include <optional>

#include "navigation/planner/grid_search.h"
#include "navigation/planner/plan.h"
#include "navigation/planner/planner_params.h"
#include "navigation/planner/shortcut.h"

namespace stereo_nav::navigation {

/// Paths for a robot of real size on an occupancy grid: A* over the cells where its outline fits, with ways
/// near obstacles made longer, and then straight ways instead of the steps of the grid.
///
/// With HeadingRule::kTravel a path may be missed where the robot can drive but not turn, in passages
/// narrower than its turning circle with bends; what is found can be driven.
class PathPlanner {
 public:
  /// Throws InputError for a footprint that cannot be used.
  explicit PathPlanner(const PlannerParams& params);

  /// Takes a map. `kept_heading_rad` counts where the robot keeps its heading: the one it has.
  void setMap(const grid::OccupancyGrid& map, double kept_heading_rad = 0.0);
  /// Follows a change of that map within `changed`.
  void update(const grid::OccupancyGrid& map, const cv::Rect& changed) { space_.update(map, changed); }

  /// A path from a pose to another; without a goal heading it ends with the one it comes with. A map must
  /// have been set.
  Plan plan(const PlanarPose& start, const Eigen::Vector2d& goal_m,
            std::optional<double> goal_heading_rad = std::nullopt);

  /// Of a path that starts at the robot: what it costs now, m; nothing where an obstacle is in its way.
  std::optional<double> costOf(const std::vector<PlanarPose>& poses) const;

  /// Poses, length, cost and clearance of a path through places in cells.
  Plan describe(const CellPath& path, const PlanarPose& start,
                std::optional<double> goal_heading_rad = std::nullopt) const;

  const RobotSpace& space() const { return space_; }
  const PlannerParams& params() const { return params_; }

 private:
  struct Ends {
    std::vector<grid::Cell> way_out;  ///< from the start's cell
    Eigen::Vector2d goal;             ///< in cells
    bool goal_moved = false;
  };

  /// The cells between which to search, or why not, in `plan`.
  std::optional<Ends> findEnds(const PlanarPose& start, const Eigen::Vector2d& goal_m, Plan& plan) const;
  Plan& refuse(Plan& plan, PlanStatus status, const std::string& text) const;
  void explainNoWay(grid::Cell start, const Eigen::Vector2d& goal, Plan& plan) const;
  double gridHeading(double map_rad) const { return map_rad - space_.geometry().origin_yaw_rad; }

  PlannerParams params_;
  RobotSpace space_;
  GridSearch search_;
};

}  // namespace stereo_nav::navigation
