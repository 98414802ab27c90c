#pragma once

#include <memory>
#include <vector>

#include "navigation/navigator/navigator.h"
#include "navigation/navigator/planning_grid.h"
#include "navigation/planner/path_planner.h"

namespace stereo_nav::navigator {

/// The path planner behind a map, or a blank grid where there is none, and the local grid: the ways of a
/// Navigator. Instead of finding ways it can keep to a given path.
class GridRoutePlanner : public RoutePlanner {
 public:
  /// Throws InputError for a footprint that cannot be used.
  explicit GridRoutePlanner(const navigation::PlannerParams& params);

  /// Takes a map. Nothing: there is none, and what the robot has not seen counts as free.
  void setMap(std::shared_ptr<const grid::OccupancyGrid> map);
  /// Takes the newest local grid, which is looked at with the next plan or look at the route.
  void see(std::shared_ptr<const grid::OccupancyGrid> local, const Eigen::Isometry2d& T_map_odom);
  /// Keeps to this path, in the frame of the map, from now on; empty: finds ways again.
  void keepTo(std::vector<Eigen::Vector2d> points_map);

  /// To the goal, or along the rest of the given path. A goal where the robot already stands gives a way of a
  /// centimetre, so that it can turn to the goal's heading.
  Route plan(const Eigen::Isometry2d& T_map_base, const Goal& goal) override;
  bool isFree(const std::vector<Eigen::Vector2d>& points_map) override;
  void clear() override;

  /// A way between two places, whatever path is given.
  navigation::Plan between(const navigation::PlanarPose& start, const Goal& goal);

  const Route& route() const { return route_; }      ///< the last one
  const std::string& note() const { return note_; }  ///< what the planner says of it; often empty
  int plans() const { return plans_; }

 private:
  /// Has the planner know what is seen, in a grid that holds both points.
  void refresh(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double heading_rad);
  bool fits(const std::vector<Eigen::Vector2d>& points_map) const;
  /// Goes along the given path to the place nearest to `p_map` that lies ahead.
  void advance(const Eigen::Vector2d& p_map);
  Route alongGiven(const navigation::PlanarPose& base);
  Route toGoal(const navigation::PlanarPose& base, const Goal& goal);

  navigation::PathPlanner planner_;
  PlanningGrid grid_;
  std::shared_ptr<const grid::OccupancyGrid> map_, local_;
  Eigen::Isometry2d T_map_odom_ = Eigen::Isometry2d::Identity();
  bool known_ = false;        ///< whether the planner has the grid
  double heading_rad_ = 0.0;  ///< with which it has it
  std::vector<Eigen::Vector2d> given_;
  std::size_t passed_ = 0;  ///< point of the given path that the robot has reached
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero();
  double left_m_ = 0.0;  ///< so far from `start_` the way leads out of obstacles
  Route route_;
  std::string note_;
  int plans_ = 0;
};

}  // namespace stereo_nav::navigator
