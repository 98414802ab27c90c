#include "test_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace stereo_nav::navigator {
namespace {

constexpr int kCells = 100;
constexpr double kCell_m = 0.1;
constexpr double kPlanMargin_m = 0.4, kSight_m = 2.0;
constexpr double kRoom_m = 5.0;

int cellOf(const Eigen::Vector2d& p) {
  const int x = std::clamp(static_cast<int>(std::floor((p.x() + kRoom_m) / kCell_m)), 0, kCells - 1);
  const int y = std::clamp(static_cast<int>(std::floor((p.y() + kRoom_m) / kCell_m)), 0, kCells - 1);
  return y * kCells + x;
}

Eigen::Vector2d centreOf(int cell) {
  return {(cell % kCells + 0.5) * kCell_m - kRoom_m, (cell / kCells + 0.5) * kCell_m - kRoom_m};
}

}  // namespace

Place TestWorld::at(const Eigen::Vector2d& p_odom) const {
  const Eigen::Vector2d p = T_world_odom * p_odom;
  if (p.cwiseAbs().maxCoeff() > kRoom_m) return Place::kOccupied;
  for (const Box& box : boxes) {
    if (box.contains(p)) return Place::kOccupied;
  }
  return seen(p) ? Place::kFree : Place::kUnseen;
}

bool TestWorld::touches(const Eigen::Isometry2d& T_world_base, double half_m) const {
  for (double x = -half_m; x <= half_m; x += 0.05) {
    for (double y = -half_m; y <= half_m; y += 0.05) {
      const Eigen::Vector2d p = T_world_base * Eigen::Vector2d(x, y);
      for (const Box& box : boxes) {
        if (box.contains(p)) return true;
      }
    }
  }
  return false;
}

bool TestPlanner::blocked(const Eigen::Vector2d& p, double margin_m) const {
  if (p.cwiseAbs().maxCoeff() > kRoom_m - margin_m) return true;
  for (std::size_t i = 0; i < world_.boxes.size() && !blind; ++i) {
    const bool known = i < surprise || world_.boxes[i].contains(p_map_, kSight_m);
    if (known && world_.boxes[i].contains(p, margin_m)) return true;
  }
  return false;
}

Route TestPlanner::plan(const Eigen::Isometry2d& T_map_base, const Goal& goal) {
  ++plans;
  const int start = cellOf(T_map_base.translation()), end = cellOf(goal.p_map);
  std::vector<double> cost(kCells * kCells, 1e9);
  std::vector<int> from(kCells * kCells, -1);
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  cost[static_cast<std::size_t>(start)] = 0.0;
  open.push({0.0, start});
  while (!open.empty()) {
    const auto [here_cost, here] = open.top();
    open.pop();
    if (here == end) break;
    if (here_cost > cost[static_cast<std::size_t>(here)]) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = here % kCells + dx, y = here / kCells + dy;
        if (x < 0 || y < 0 || x >= kCells || y >= kCells) continue;
        const int next = y * kCells + x;
        const double next_cost = here_cost + std::hypot(dx, dy);
        if (next_cost >= cost[static_cast<std::size_t>(next)] || blocked(centreOf(next), kPlanMargin_m))
          continue;
        cost[static_cast<std::size_t>(next)] = next_cost;
        from[static_cast<std::size_t>(next)] = here;
        open.push({next_cost, next});
      }
    }
  }
  if (from[static_cast<std::size_t>(end)] < 0 && start != end) return {{}, "no way to the goal is free"};
  Route route;
  for (int cell = from[static_cast<std::size_t>(end)]; cell >= 0 && cell != start;
       cell = from[static_cast<std::size_t>(cell)])
    route.points_map.push_back(centreOf(cell));
  route.points_map.insert(route.points_map.begin(), goal.p_map);
  route.points_map.push_back(T_map_base.translation());
  std::reverse(route.points_map.begin(), route.points_map.end());
  return route;
}

bool TestPlanner::isFree(const std::vector<Eigen::Vector2d>& points_map) {
  return std::none_of(points_map.begin(), points_map.end(),
                      [this](const auto& p) { return blocked(p, kPlanMargin_m - kCell_m); });
}

ClosedLoop::ClosedLoop(const NavigatorParams& params_in)
    : params(params_in), planner(world), navigator(params, planner), under_way_(params.control.drive) {}

void ClosedLoop::step(const std::function<void(Situation&)>& change) {
  Situation situation;
  situation.now_s = situation.odometry_stamp_s = situation.surroundings_stamp_s = time_s;
  situation.T_map_odom = world.T_world_odom;
  situation.state = state;
  situation.state.T_world_base = world.T_world_odom.inverse() * state.T_world_base;
  situation.surroundings = &world;
  change(situation);
  planner.look(state.T_world_base.translation());
  command = navigator.update(situation);
  under_way_.add(time_s, wheels_blocked ? Twist(Twist::Zero()) : command);
  state = under_way_.predicted(state, time_s, time_s + 0.02);
  time_s += 0.02;
  const bool moves = state.twist.norm() > 0.02;
  touched_in_motion = touched_in_motion || (moves && world.touches(state.T_world_base, 0.25));
}

void ClosedLoop::run(double most_s, const std::function<void(Situation&)>& change) {
  for (const double end_s = time_s + most_s; time_s < end_s;) {
    step(change);
    const bool active =
        navigator.mode() == NavigatorMode::kDriving || navigator.mode() == NavigatorMode::kRecovering;
    if (!active && state.twist.norm() < 1e-3) return;
  }
}

}  // namespace stereo_nav::navigator
