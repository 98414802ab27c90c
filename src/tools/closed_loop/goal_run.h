#pragma once

#include <string>
#include <vector>

#include "navigation/navigator/grid_route_planner.h"
#include "nodes/navigator/navigator_node_params.h"
#include "tools/closed_loop/robot_senses.h"

namespace stereo_nav::tools {

/// What became of a goal.
struct GoalResult {
  Eigen::Vector2d goal_world = Eigen::Vector2d::Zero();  ///< m
  bool arrived = false;        ///< as the navigator says; otherwise `words` names the failure
  std::string words;           ///< the navigator's last ones
  double duration_s = 0.0;     ///< from the goal to the end
  double way_m = 0.0;          ///< that the robot has truly gone since the start of the run
  double distance_m = 0.0;     ///< from its true place to the goal at the end
  std::size_t collisions = 0;  ///< while it moved, on the way to this goal
  /// Whether it is where an odometry as good as asked for takes it: 5 cm and 0.3 % of the way from the goal.
  bool isThere() const { return arrived && distance_m <= 0.05 + 0.003 * way_m; }
};

/// A moment of the run.
struct TracePoint {
  double time_s;
  Eigen::Vector2d truth, estimate;  ///< place of base_link in the world, m
  navigator::Twist command;         ///< m/s, m/s, rad/s
  std::string words;                ///< of the navigator
};

/// A robot that is driven to goals by the navigator, with what it senses alone.
class GoalRun {
 public:
  /// The simulation and the senses must outlive it. `map`: in the world's frame; nothing: it has none.
  GoalRun(const nodes::NavigatorNodeParams& params, sim::DrivenSimulation& simulation, RobotSenses& senses,
          std::shared_ptr<const grid::OccupancyGrid> map);

  /// Lets the robot stand, so that the odometry starts.
  void wait(double duration_s);
  GoalResult driveTo(const Eigen::Vector2d& goal_world);

  const std::vector<TracePoint>& trace() const { return trace_; }

 private:
  /// One period; returns whether the navigator has a goal still.
  bool step();

  nodes::NavigatorNodeParams params_;
  sim::DrivenSimulation& simulation_;
  RobotSenses& senses_;
  navigator::GridRoutePlanner planner_;
  navigator::Navigator navigator_;
  std::vector<TracePoint> trace_;
  double way_m_ = 0.0;
};

}  // namespace stereo_nav::tools
