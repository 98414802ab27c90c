#include "tools/closed_loop/course.h"

#include <memory>

#include "navigation/navigator/grid_route_planner.h"
#include "sim/random.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::tools {
namespace {

constexpr double kRoom_m = 0.5, kNearest_m = 1.0;
constexpr int kMostDraws = 10000;

bool isClear(const grid::OccupancyGrid& walls, const Eigen::Vector2d& p_world) {
  const double cell_m = walls.geometry.resolution_m;
  for (double y = -kRoom_m; y <= kRoom_m; y += cell_m) {
    for (double x = -kRoom_m; x <= kRoom_m; x += cell_m) {
      const Eigen::Vector2d p = (p_world + Eigen::Vector2d(x, y) -
                                 Eigen::Vector2d(walls.geometry.origin_x_m, walls.geometry.origin_y_m)) /
                                cell_m;
      const grid::Cell cell = grid::cellHolding(p);
      if (!walls.geometry.contains(cell) || walls.at(cell) != grid::kFree) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<Eigen::Vector2d> pathGoals(const sim::Scenario& scenario, const Eigen::Vector2d& start,
                                       bool back) {
  std::vector<Eigen::Vector2d> goals;
  for (const sim::PathStep& step : scenario.path)
    if (step.action == sim::PathStep::Action::kDriveTo) goals.emplace_back(step.x_m, step.y_m);
  if (goals.empty()) throw InputError("the scenario has no path whose places could be goals; use --random");
  if (!back) return goals;
  for (std::size_t i = goals.size() - 1; i > 0; --i) goals.push_back(goals[i - 1]);
  goals.push_back(start);
  return goals;
}

std::vector<Eigen::Vector2d> randomGoals(const grid::OccupancyGrid& walls,
                                         const navigation::PlannerParams& params,
                                         const Eigen::Vector2d& start, int count, std::uint64_t seed) {
  navigator::GridRoutePlanner planner(params);
  planner.setMap(std::make_shared<const grid::OccupancyGrid>(walls));
  sim::RandomStream random(seed);
  const grid::GridGeometry& area = walls.geometry;
  std::vector<Eigen::Vector2d> goals;
  Eigen::Vector2d from = start;
  for (int draw = 0; draw < kMostDraws && goals.size() < static_cast<std::size_t>(count); ++draw) {
    const Eigen::Vector2d goal(area.origin_x_m + random.uniform(0.0, area.width * area.resolution_m),
                               area.origin_y_m + random.uniform(0.0, area.height * area.resolution_m));
    if ((goal - from).norm() < kNearest_m || !isClear(walls, goal)) continue;
    if (planner.between({from, 0.0}, {goal, std::nullopt}).poses.empty()) continue;
    goals.push_back(goal);
    from = goal;
  }
  if (goals.size() < static_cast<std::size_t>(count))
    throw InputError("the room has hardly a place with half a metre free around it that the robot can reach");
  return goals;
}

}  // namespace stereo_nav::tools
