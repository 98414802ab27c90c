#include "navigation/navigator/motion_check.h"

#include <algorithm>
#include <cmath>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::navigator {
namespace {

constexpr double kSpacing_m = 0.05;  ///< of the points of the outline
constexpr double kStep_s = 0.05;
constexpr double kRounding_m = 1e-3;  ///< little, or it would creep over unseen ground
constexpr double kAhead_rad = 1.0;    ///< to either side, of what counts as ahead
constexpr double kStands = 1e-3;      ///< m/s and rad/s
constexpr double kMostBraking_s = 3.0;

void addSide(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::vector<Eigen::Vector2d>& points) {
  const int pieces = std::max(1, static_cast<int>(std::ceil((to - from).norm() / kSpacing_m)));
  for (int i = 0; i < pieces; ++i) points.push_back(from + (to - from) * (static_cast<double>(i) / pieces));
}

}  // namespace

void MotionCheckParams::describe(ParameterVisitor& visitor) {
  visitor.real("horizon_s", horizon_s, {0.1, 5.0}, "s", "for so long the coming motion is checked");
  visitor.real("margin_m", margin_m, {0.0, 1.0}, "m", "kept free around the base");
  visitor.flag("into_unseen", into_unseen, "whether the base may move where nothing has been seen");
  visitor.real(
      "blind_zone_m", blind_zone_m, {0.0, 3.0}, "m",
      "floor ahead of base_link that is nearer than this counts as seen, unless something was seen there: for "
      "a robot whose cameras do not see it and that has no laser; 0: it does not");
}

MotionCheck::MotionCheck(const MotionCheckParams& params, const control::DriveModelParams& drive)
    : params_(params), drive_(drive) {
  validateParameters(params, "motion check");
  const double x_m = 0.5 * params.length_m + params.margin_m, y_m = 0.5 * params.width_m + params.margin_m;
  const Eigen::Vector2d corners[] = {{x_m, y_m}, {-x_m, y_m}, {-x_m, -y_m}, {x_m, -y_m}};
  for (int i = 0; i < 4; ++i) addSide(corners[i], corners[(i + 1) % 4], outline_);
  circle_m_ = std::hypot(x_m, y_m) + kRounding_m;
}

MotionCheck::Result MotionCheck::check(const control::DriveState& state, const control::Twist& command,
                                       const Surroundings& surroundings) const {
  const std::vector<bool> touches = touching(state.T_world_base, surroundings);
  Result result;
  for (const double share : {1.0, 0.75, 0.5, 0.25}) {
    const Finding finding = along(state, share * command, surroundings, touches);
    result.share = share;
    if (finding == Finding::kClear) return result;
    result.by_unseen = finding == Finding::kUnseen;
  }
  result.share = 0.0;
  return result;
}

std::vector<bool> MotionCheck::touching(const Eigen::Isometry2d& T_odom_base,
                                        const Surroundings& surroundings) const {
  std::vector<bool> touches;
  for (const auto& p_base : outline_)
    touches.push_back(surroundings.at(T_odom_base * p_base) == Place::kOccupied);
  return touches;
}

MotionCheck::Finding MotionCheck::along(const control::DriveState& state, const control::Twist& command,
                                        const Surroundings& surroundings,
                                        const std::vector<bool>& touches) const {
  // Until the command acts, the base moves on as it does.
  control::DriveState moving = control::advanced(drive_, state, state.twist, drive_.dead_time_s);
  for (double time_s = 0.0; time_s < params_.horizon_s + kMostBraking_s; time_s += kStep_s) {
    const bool braking = time_s >= params_.horizon_s;
    moving = control::advanced(drive_, moving, braking ? control::Twist::Zero() : command, kStep_s);
    const Finding finding = at(moving.T_world_base, state.T_world_base, surroundings, touches);
    if (finding != Finding::kClear) return finding;
    if (braking && moving.twist.norm() < kStands) break;
  }
  const auto before = std::count(touches.begin(), touches.end(), true);
  if (before == 0) return Finding::kClear;
  const std::vector<bool> at_end = touching(moving.T_world_base, surroundings);
  return std::count(at_end.begin(), at_end.end(), true) < before ? Finding::kClear : Finding::kObstacle;
}

bool MotionCheck::isGranted(const Eigen::Vector2d& p_start) const {
  const double distance_m = p_start.norm();
  return distance_m <= circle_m_ ||
         (distance_m <= params_.blind_zone_m && std::abs(std::atan2(p_start.y(), p_start.x())) < kAhead_rad);
}

MotionCheck::Finding MotionCheck::at(const Eigen::Isometry2d& T_odom_base,
                                     const Eigen::Isometry2d& T_odom_start, const Surroundings& surroundings,
                                     const std::vector<bool>& touches) const {
  const Eigen::Isometry2d T_start_base = T_odom_start.inverse() * T_odom_base;
  for (std::size_t i = 0; i < outline_.size(); ++i) {
    if (touches[i]) continue;
    const Eigen::Vector2d p_odom = T_odom_base * outline_[i];
    const Place place = surroundings.at(p_odom);
    if (place == Place::kOccupied) return Finding::kObstacle;
    if (place == Place::kUnseen && !params_.into_unseen && !isGranted(T_start_base * outline_[i]))
      return Finding::kUnseen;
  }
  return Finding::kClear;
}

}  // namespace stereo_nav::navigator
