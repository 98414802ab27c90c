#include "navigation/control/speed_profile.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::control {
namespace {

constexpr double kStraight_per_m = 1e-6;
/// What braking may exceed its limit by, to return to a profile that was left by a hair.
constexpr double kFirmer = 1.3;

/// The highest speed in a curve: what does not depend on other places of the path.
double speedInCurve(double curvature_per_m, double bend_per_m2, const SpeedLimits& limits,
                    const std::optional<WheelSpeedLimit>& wheels) {
  const double curvature = std::abs(curvature_per_m), bend = std::abs(bend_per_m2);
  double speed = limits.max_speed_m_per_s;
  if (curvature > kStraight_per_m) {
    speed = std::min(speed, std::sqrt(limits.max_lateral_acceleration_m_per_s2 / curvature));
    speed = std::min(speed, limits.max_turn_rate_rad_per_s / curvature);
  }
  // The turning rate v k changes by v^2 dk/ds while the speed is constant.
  if (bend > kStraight_per_m)
    speed = std::min(speed, std::sqrt(limits.max_turn_acceleration_rad_per_s2 / bend));
  if (wheels) {
    double fastest = 0.0;
    for (const auto& wheel : wheels->drive.inverse({1.0, 0.0, curvature_per_m}))
      fastest = std::max(fastest, std::abs(wheel.speed_m_per_s));
    if (fastest > 0.0) speed = std::min(speed, wheels->max_speed_m_per_s / fastest);
  }
  return speed;
}

/// Change of curvature along the path, by the neighbours of a point.
double bendAt(const std::vector<PathPoint>& points, std::size_t i) {
  const PathPoint& before = points[i == 0 ? 0 : i - 1];
  const PathPoint& after = points[std::min(i + 1, points.size() - 1)];
  return (after.curvature_per_m - before.curvature_per_m) / (after.arc_m - before.arc_m);
}

}  // namespace

void SpeedLimits::describe(ParameterVisitor& visitor) {
  visitor.real("max_speed_m_per_s", max_speed_m_per_s, {0.01, 20.0}, "m/s", "on a straight way");
  visitor.real("max_acceleration_m_per_s2", max_acceleration_m_per_s2, {0.01, 50.0}, "m/s^2",
               "when it becomes faster");
  visitor.real("max_braking_m_per_s2", max_braking_m_per_s2, {0.01, 50.0}, "m/s^2", "when it becomes slower");
  visitor.real("max_lateral_acceleration_m_per_s2", max_lateral_acceleration_m_per_s2, {0.01, 50.0}, "m/s^2",
               "across the path in a curve");
  visitor.real("max_turn_rate_rad_per_s", max_turn_rate_rad_per_s, {0.01, 50.0}, "rad/s",
               "in curves and on the spot");
  visitor.real("max_turn_acceleration_rad_per_s2", max_turn_acceleration_rad_per_s2, {0.01, 200.0}, "rad/s^2",
               "change of the turning rate in curves and on the spot");
  visitor.real("end_gain_per_s", end_gain_per_s, {0.1, 20.0}, "1/s",
               "speed near the end, for each metre that is left");
}

PathSpeedProfile::PathSpeedProfile(const Path& path, const SpeedLimits& limits,
                                   const std::optional<WheelSpeedLimit>& wheels)
    : end_gain_per_s_(limits.end_gain_per_s) {
  const auto& points = path.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double speed = speedInCurve(points[i].curvature_per_m, bendAt(points, i), limits, wheels);
    arc_m_.push_back(points[i].arc_m);
    squared_.push_back(speed * speed);
  }
  squared_.back() = 0.0;
  for (std::size_t i = squared_.size() - 1; i > 0; --i) {
    const double gained = 2.0 * limits.max_braking_m_per_s2 * (arc_m_[i] - arc_m_[i - 1]);
    squared_[i - 1] = std::min(squared_[i - 1], squared_[i] + gained);
  }
}

double PathSpeedProfile::limit(double arc_m) const {
  arc_m = std::clamp(arc_m, 0.0, arc_m_.back());
  const auto after = std::upper_bound(arc_m_.begin() + 1, arc_m_.end() - 1, arc_m);
  const std::size_t i = static_cast<std::size_t>(after - arc_m_.begin());
  const double share = (arc_m - arc_m_[i - 1]) / (arc_m_[i] - arc_m_[i - 1]);
  const double squared = squared_[i - 1] + share * (squared_[i] - squared_[i - 1]);
  return std::min(std::sqrt(squared), end_gain_per_s_ * (arc_m_.back() - arc_m));
}

double SpeedGovernor::next(double limit_m_per_s, double period_s) {
  const double before = speed_m_per_s_;
  speed_m_per_s_ = std::clamp(limit_m_per_s, before - kFirmer * limits_.max_braking_m_per_s2 * period_s,
                              before + limits_.max_acceleration_m_per_s2 * period_s);
  acceleration_m_per_s2_ = (speed_m_per_s_ - before) / period_s;
  return speed_m_per_s_;
}

}  // namespace stereo_nav::control
