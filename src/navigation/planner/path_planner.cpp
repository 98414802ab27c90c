#include "navigation/planner/path_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/angles.h"
#include "navigation/planner/ends.h"

namespace stereo_nav::navigation {
namespace {

std::string point(const Eigen::Vector2d& p_m) {
  return fmt::format("({:.3f}, {:.3f})", p_m.x(), p_m.y());
}

}  // namespace

PathPlanner::PathPlanner(const PlannerParams& params)
    : params_(params), space_(params.makeFootprint(), params.heading, params.clearance, params.unknown) {}

void PathPlanner::setMap(const grid::OccupancyGrid& map, double kept_heading_rad) {
  space_.setMap(map, kept_heading_rad);
}

Plan PathPlanner::plan(const PlanarPose& start, const Eigen::Vector2d& goal_m,
                       std::optional<double> goal_heading_rad) {
  Plan plan;
  const std::optional<Ends> ends = findEnds(start, goal_m, plan);
  if (!ends) return plan;
  const grid::Cell first = ends->way_out.back();
  const std::uint8_t first_moves = firstMoves(space_, first, gridHeading(start.heading_rad));
  const GridPath found =
      search_.find(space_.moves(), first, grid::cellHolding(ends->goal), params_.search, first_moves);
  if (!found.found()) {
    explainNoWay(first, ends->goal, plan);
    return plan;
  }
  if (plan.status != PlanStatus::kGoalMoved) plan.status = PlanStatus::kFound;
  // The way out, if there is one, stays as it is: it leads through obstacles, so that nothing could be said
  // for a shortcut.
  const bool leaves = ends->way_out.size() > 1;
  CellPath path;
  for (const grid::Cell cell : found.cells) path.push_back(grid::centreInCells(cell));
  const Eigen::Vector2d exact = space_.geometry().inCells(start.position_m);
  if (!leaves && (path.size() == 1 || space_.fitsAlong(exact, path[1]))) path.front() = exact;
  if (path.size() > 1 && space_.fitsAlong(path[path.size() - 2], ends->goal)) path.back() = ends->goal;
  path = shortened(space_, path, params_.shortcut_slack);
  if (leaves) {
    CellPath out;
    for (const grid::Cell cell : ends->way_out) out.push_back(grid::centreInCells(cell));
    out = bendsOf(out);
    out.front() = exact;
    out.pop_back();
    path.insert(path.begin(), out.begin(), out.end());
    plan.left_m = (grid::centreInCells(first) - exact).norm() * space_.geometry().resolution_m;
    plan.text += fmt::format(
        "the robot touches an obstacle at the start; the path first leads {:.2f} m away from it. ",
        plan.left_m);
  }
  Plan described = describe(path, start, goal_heading_rad);
  described.status = plan.status;
  described.left_m = plan.left_m;
  described.text = plan.text + described.text;
  return described;
}

std::optional<PathPlanner::Ends> PathPlanner::findEnds(const PlanarPose& start, const Eigen::Vector2d& goal_m,
                                                       Plan& plan) const {
  const grid::GridGeometry& geometry = space_.geometry();
  const grid::Cell start_cell = geometry.cellAt(start.position_m);
  const grid::Cell goal_cell = geometry.cellAt(goal_m);
  for (const auto& [name, cell, place] :
       {std::make_tuple("start", start_cell, start.position_m), std::make_tuple("goal", goal_cell, goal_m)}) {
    if (geometry.contains(cell)) continue;
    refuse(plan, PlanStatus::kOutside,
           fmt::format("the {} {} is not on the map; is it in the map's frame?", name, point(place)));
    return std::nullopt;
  }
  Ends ends;
  ends.way_out =
      wayOutOfObstacles(space_, start_cell, static_cast<int>(params_.leave_within_m / geometry.resolution_m));
  if (ends.way_out.empty()) {
    refuse(
        plan, PlanStatus::kStartBlocked,
        fmt::format(
            "the robot at {} touches obstacles, and nothing within {} m leads away from them; push it free, or clear what "
            "is wrong in the map",
            point(start.position_m), params_.leave_within_m));
    return std::nullopt;
  }
  ends.goal = geometry.inCells(goal_m);
  if (space_.fitsSomehow(goal_cell)) return ends;
  const grid::Cell nearest = nearestCell(reachableFrom(space_.moves(), ends.way_out.back()), ends.goal);
  const double distance_m = (grid::centreInCells(nearest) - ends.goal).norm() * geometry.resolution_m;
  const std::string where = fmt::format(
      "the robot does not fit at the goal {}; the nearest point that it can reach is {}, {:.2f} m away",
      point(goal_m), point(geometry.centreOf(nearest)), distance_m);
  if (distance_m > params_.goal_tolerance_m) {
    refuse(plan, PlanStatus::kGoalBlocked,
           fmt::format("{}, more than the tolerance of {} m", where, params_.goal_tolerance_m));
    return std::nullopt;
  }
  ends.goal = grid::centreInCells(nearest);
  ends.goal_moved = true;
  plan.status = PlanStatus::kGoalMoved;
  plan.text = where + ": the path ends there. ";
  return ends;
}

Plan& PathPlanner::refuse(Plan& plan, PlanStatus status, const std::string& text) const {
  plan.status = status;
  plan.text = text;
  return plan;
}

void PathPlanner::explainNoWay(grid::Cell start, const Eigen::Vector2d& goal, Plan& plan) const {
  const grid::Cell nearest = nearestCell(reachableFrom(space_.moves(), start), goal);
  const double distance_m = (grid::centreInCells(nearest) - goal).norm() * space_.geometry().resolution_m;
  const std::string places = fmt::format("from {} to {}", point(space_.geometry().centreOf(start)),
                                         point(space_.geometry().fromCells(goal)));
  if (nearest == grid::cellHolding(goal)) {
    refuse(
        plan, PlanStatus::kNoWay,
        fmt::format(
            "no way {}: where the robot could pass it cannot turn; begin with another heading, or use a smaller footprint",
            places));
    return;
  }
  refuse(plan, PlanStatus::kNoWay,
         fmt::format("no way that is wide enough leads {}; the robot gets as near as {:.2f} m, to {}", places,
                     distance_m, point(space_.geometry().centreOf(nearest))));
}

Plan PathPlanner::describe(const CellPath& path, const PlanarPose& start,
                           std::optional<double> goal_heading_rad) const {
  Plan plan;
  plan.status = PlanStatus::kFound;
  const grid::GridGeometry& geometry = space_.geometry();
  double clearance = std::numeric_limits<double>::infinity();
  double heading = gridHeading(start.heading_rad);
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0) {
      const Eigen::Vector2d way = path[i] - path[i - 1];
      heading = space_.headingAlong(way);
      plan.length_m += way.norm() * geometry.resolution_m;
      plan.cost_m += space_.costAlong(path[i - 1], path[i]) * geometry.resolution_m;
      const int samples = std::max(1, static_cast<int>(std::ceil(way.norm())));
      for (int s = 0; s <= samples; ++s)
        clearance = std::min(clearance, space_.clearance(path[i - 1] + way * s / samples, heading));
    }
    plan.poses.push_back({geometry.fromCells(path[i]), wrapRadians(heading + geometry.origin_yaw_rad)});
  }
  plan.clearance_m = std::isfinite(clearance) ? clearance * geometry.resolution_m : 0.0;
  if (!goal_heading_rad) return plan;
  if (space_.fitsTurning(path.back(), heading, gridHeading(*goal_heading_rad))) {
    plan.poses.back().heading_rad = wrapRadians(*goal_heading_rad);
  } else {
    plan.text += "the robot cannot turn to the heading of the goal there: something is too near. ";
  }
  return plan;
}

std::optional<double> PathPlanner::costOf(const std::vector<PlanarPose>& poses) const {
  double cost = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Eigen::Vector2d from = space_.geometry().inCells(poses[i - 1].position_m),
                          to = space_.geometry().inCells(poses[i].position_m);
    if (from == to) continue;
    if (!space_.fitsAlong(from, to)) return std::nullopt;
    cost += space_.costAlong(from, to) * space_.geometry().resolution_m;
  }
  return cost;
}

}  // namespace stereo_nav::navigation
