#include "navigation/planner/replanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace stereo_nav::navigation {
namespace {

/// The point of a straight way that is nearest to `p`, as a share of the way.
double nearestShare(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& p) {
  const Eigen::Vector2d way = to - from;
  const double squared = way.squaredNorm();
  return squared == 0.0 ? 1.0 : std::clamp((p - from).dot(way) / squared, 0.0, 1.0);
}

}  // namespace

void Replanner::setGoal(const Eigen::Vector2d& goal_m, std::optional<double> goal_heading_rad) {
  goal_m_ = goal_m;
  goal_heading_rad_ = goal_heading_rad;
  plan_ = Plan();
  better_by_ = planner_.params().better_by;
}

Replanner::Decision Replanner::update(const PlanarPose& robot) {
  const Plan fresh = planner_.plan(robot, goal_m_, goal_heading_rad_);
  if (!plan_.found()) return take(fresh, Change::kFirst, "");
  advanceTo(robot);
  const std::optional<double> cost_m = planner_.costOf(plan_.poses);
  if (!cost_m && plan_.left_m == 0.0)
    return take(fresh, Change::kBlocked, "an obstacle is in the way: planned anew");
  if (cost_m) plan_.cost_m = *cost_m;
  if (!fresh.found() || fresh.status != plan_.status || fresh.cost_m >= (1.0 - better_by_) * plan_.cost_m)
    return {Change::kKept, ""};
  const std::string text = fmt::format("another way costs {:.2f} m instead of {:.2f} m: changed to it",
                                       fresh.cost_m, plan_.cost_m);
  better_by_ = std::min(1.0, 2.0 * better_by_);
  return take(fresh, Change::kBetter, text);
}

Replanner::Decision Replanner::take(const Plan& plan, Change change, const std::string& text) {
  plan_ = plan;
  if (!plan_.found()) return {Change::kNone, plan_.text};
  return {change, text.empty() || plan_.text.empty() ? text + plan_.text : text + "; " + plan_.text};
}

void Replanner::advanceTo(const PlanarPose& robot) {
  std::size_t next = 1;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < plan_.poses.size(); ++i) {
    const Eigen::Vector2d from = plan_.poses[i - 1].position_m, to = plan_.poses[i].position_m;
    const double distance_m =
        (from + nearestShare(from, to, robot.position_m) * (to - from) - robot.position_m).norm();
    if (distance_m >= least_m - 1e-9) continue;
    least_m = distance_m;
    next = i;
  }
  if (plan_.poses.size() < 2) return;
  plan_.poses.erase(plan_.poses.begin(), plan_.poses.begin() + static_cast<std::ptrdiff_t>(next) - 1);
  plan_.poses.front() = robot;
}

}  // namespace stereo_nav::navigation
