#include "tools/closed_loop/goal_run.h"

#include <cmath>
#include <utility>

namespace stereo_nav::tools {
namespace {

/// No goal of a course takes longer; what does is a failure without a name.
constexpr double kLongest_s = 120.0;

}  // namespace

GoalRun::GoalRun(const nodes::NavigatorNodeParams& params, sim::DrivenSimulation& simulation,
                 RobotSenses& senses, std::shared_ptr<const grid::OccupancyGrid> map)
    : params_(params),
      simulation_(simulation),
      senses_(senses),
      planner_(params.planner),
      navigator_(params.navigator, planner_) {
  planner_.setMap(std::move(map));
}

void GoalRun::wait(double duration_s) {
  const double end_s = simulation_.time_s() + duration_s;
  while (simulation_.time_s() < end_s) step();
}

bool GoalRun::step() {
  const Eigen::Vector2d before = simulation_.state().T_world_base.translation().head<2>();
  simulation_.advance(simulation_.time_s() + params_.navigator.control.period_s, senses_);
  const Eigen::Vector2d truth = simulation_.state().T_world_base.translation().head<2>();
  way_m_ += (truth - before).norm();
  senses_.process(simulation_.time_s());
  const auto situation = senses_.situation(simulation_.time_s());
  if (!situation) return true;
  if (const auto grid = senses_.localGrid()) planner_.see(grid, situation->T_map_odom);
  const navigator::Twist command = navigator_.update(*situation);
  simulation_.command(command);
  const Eigen::Isometry2d T_world_base = situation->T_map_odom * situation->state.T_world_base;
  trace_.push_back({simulation_.time_s(), truth, T_world_base.translation(), command, navigator_.words()});
  return navigator_.mode() == navigator::NavigatorMode::kDriving ||
         navigator_.mode() == navigator::NavigatorMode::kRecovering;
}

GoalResult GoalRun::driveTo(const Eigen::Vector2d& goal_world) {
  const double start_s = simulation_.time_s();
  const std::size_t collisions = senses_.collisions().size();
  navigator_.setGoal({goal_world, std::nullopt});
  bool on_the_way = true;
  while (on_the_way && simulation_.time_s() < start_s + kLongest_s) on_the_way = step();
  GoalResult result;
  result.goal_world = goal_world;
  result.duration_s = simulation_.time_s() - start_s;
  result.arrived = navigator_.mode() == navigator::NavigatorMode::kArrived;
  result.words = on_the_way ? "no end within the time: " + navigator_.words() : navigator_.words();
  if (on_the_way) navigator_.cancel();
  wait(0.5);  // until it stands
  const Eigen::Vector2d truth = simulation_.state().T_world_base.translation().head<2>();
  result.way_m = way_m_;
  result.distance_m = (truth - goal_world).norm();
  result.collisions = senses_.collisions().size() - collisions;
  return result;
}

}  // namespace stereo_nav::tools
