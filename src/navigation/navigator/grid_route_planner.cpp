#include "navigation/navigator/grid_route_planner.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace stereo_nav::navigator {
namespace {

constexpr double kBlankMargin_m = 5.0, kBlankResolution_m = 0.05;
constexpr double kAhead_m = 1.0;  ///< so far ahead the robot is sought on a given path
constexpr double kJoin_m = 0.1;   ///< a given path that is nearer is entered straight
constexpr double kLeastWay_m = 0.01;
constexpr double kStraight = 1e-4;  ///< sine of a bend that is none

navigation::PlanarPose poseOf(const Eigen::Isometry2d& T_map_base) {
  return {T_map_base.translation(), std::atan2(T_map_base.linear()(1, 0), T_map_base.linear()(0, 0))};
}

/// The ends and bends of a polyline, as the poses that the planner takes.
std::vector<navigation::PlanarPose> bendsOf(const std::vector<Eigen::Vector2d>& points) {
  std::vector<navigation::PlanarPose> poses;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0 && i + 1 < points.size()) {
      const Eigen::Vector2d before = (points[i] - poses.back().position_m).normalized(),
                            after = (points[i + 1] - points[i]).normalized();
      if (std::abs(before.x() * after.y() - before.y() * after.x()) < kStraight && before.dot(after) > 0.0)
        continue;
    }
    poses.push_back({points[i], 0.0});
  }
  return poses;
}

}  // namespace

GridRoutePlanner::GridRoutePlanner(const navigation::PlannerParams& params) : planner_(params) {}

void GridRoutePlanner::setMap(std::shared_ptr<const grid::OccupancyGrid> map) {
  map_ = std::move(map);
  grid_ = PlanningGrid();
  if (map_) grid_.setMap(*map_);
  known_ = false;
}

void GridRoutePlanner::see(std::shared_ptr<const grid::OccupancyGrid> local,
                           const Eigen::Isometry2d& T_map_odom) {
  local_ = std::move(local);
  T_map_odom_ = T_map_odom;
}

void GridRoutePlanner::keepTo(std::vector<Eigen::Vector2d> points_map) {
  given_ = std::move(points_map);
  passed_ = 0;
}

void GridRoutePlanner::clear() {
  grid_.forgetSeen();
  known_ = false;
}

Route GridRoutePlanner::plan(const Eigen::Isometry2d& T_map_base, const Goal& goal) {
  const navigation::PlanarPose base = poseOf(T_map_base);
  start_ = base.position_m;
  left_m_ = 0.0;
  note_.clear();
  ++plans_;
  route_ = given_.empty() ? toGoal(base, goal) : alongGiven(base);
  return route_;
}

Route GridRoutePlanner::toGoal(const navigation::PlanarPose& base, const Goal& goal) {
  const navigation::Plan plan = between(base, goal);
  if (!plan.found()) return {{}, plan.text};
  left_m_ = plan.left_m;
  note_ = plan.text;
  Route route;
  for (const auto& pose : plan.poses) route.points_map.push_back(pose.position_m);
  if (route.points_map.size() > 1) return route;
  const Eigen::Vector2d ahead(std::cos(base.heading_rad), std::sin(base.heading_rad));
  const bool there = plan.status == navigation::PlanStatus::kGoalMoved ||
                     (goal.p_map - base.position_m).norm() < kLeastWay_m;
  route.points_map = {base.position_m, there ? base.position_m + kLeastWay_m * ahead : goal.p_map};
  return route;
}

Route GridRoutePlanner::alongGiven(const navigation::PlanarPose& base) {
  advance(base.position_m);
  const std::vector<Eigen::Vector2d> rest(given_.begin() + static_cast<std::ptrdiff_t>(passed_),
                                          given_.end());
  Route route{{base.position_m}, ""};
  if ((rest.front() - base.position_m).norm() > kJoin_m) {
    route = toGoal(base, {rest.front(), std::nullopt});
    if (route.points_map.empty()) return {{}, "no way to the given path: " + route.reason};
  }
  refresh(base.position_m, rest.back(), base.heading_rad);
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (fits({rest[i - 1], rest[i]})) continue;
    return {{},
            fmt::format("the given path is blocked, or leaves the map, at ({:.2f}, {:.2f})", rest[i].x(),
                        rest[i].y())};
  }
  route.points_map.insert(route.points_map.end(), rest.begin(), rest.end());
  return route;
}

bool GridRoutePlanner::isFree(const std::vector<Eigen::Vector2d>& points_map) {
  if (points_map.empty()) return true;
  if (!given_.empty()) advance(points_map.front());
  refresh(points_map.front(), points_map.back(), heading_rad_);
  auto first = points_map.begin();
  while (left_m_ > 0.0 && first != points_map.end() && (*first - start_).norm() < left_m_ + kJoin_m) ++first;
  return fits({first, points_map.end()});
}

navigation::Plan GridRoutePlanner::between(const navigation::PlanarPose& start, const Goal& goal) {
  refresh(start.position_m, goal.p_map, start.heading_rad);
  return planner_.plan(start, goal.p_map, goal.heading_rad);
}

void GridRoutePlanner::refresh(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double heading_rad) {
  if (!map_ && grid_.setBlank(a, b, kBlankMargin_m, kBlankResolution_m)) known_ = false;
  const cv::Rect changed = local_ ? grid_.see(*local_, T_map_odom_) : cv::Rect();
  const bool turned =
      planner_.params().heading == navigation::HeadingRule::kKept && heading_rad != heading_rad_;
  if (!known_ || turned)
    planner_.setMap(grid_.grid(), heading_rad);
  else
    planner_.update(grid_.grid(), changed);
  known_ = true;
  heading_rad_ = heading_rad;
}

bool GridRoutePlanner::fits(const std::vector<Eigen::Vector2d>& points_map) const {
  return planner_.costOf(bendsOf(points_map)).has_value();
}

void GridRoutePlanner::advance(const Eigen::Vector2d& p_map) {
  double way_m = 0.0;
  std::size_t nearest = passed_;
  for (std::size_t i = passed_ + 1; i < given_.size() && way_m < kAhead_m; ++i) {
    way_m += (given_[i] - given_[i - 1]).norm();
    if ((given_[i] - p_map).norm() < (given_[nearest] - p_map).norm()) nearest = i;
  }
  passed_ = nearest;
}

}  // namespace stereo_nav::navigator
