#include "navigation/control/as_published.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"

namespace stereo_nav::control {
namespace {

constexpr double kArrived_m = 0.03;
constexpr double kNearSearch_m = 1.0;

}  // namespace

Twist PublishedPursuit::command(const DriveState& state, double /*stamp_s*/, double /*now_s*/) {
  const auto& points = path_.points();
  const Eigen::Vector2d position = state.T_world_base.translation();
  const auto distance = [&](std::size_t i) { return (points[i].position - position).norm(); };
  const std::size_t last = points.size() - 1;
  while (nearest_ < last && distance(nearest_ + 1) < distance(nearest_)) ++nearest_;
  finished_ = finished_ ||
              (points[last].arc_m - points[nearest_].arc_m < kNearSearch_m && distance(last) < kArrived_m);
  if (finished_) return Twist::Zero();

  const double look_ahead_m = params_.look_ahead_gain_s * state.twist.head<2>().norm() + params_.look_ahead_m;
  std::size_t target = nearest_;
  while (target < last && distance(target) < look_ahead_m) ++target;
  const Eigen::Vector2d to_target = (points[target].position - position).normalized();
  const Eigen::Vector2d velocity = params_.speed_m_per_s * to_target;
  return kinematics::fromField({velocity.x(), velocity.y(), 0.0}, state.heading_rad());
}

Twist PublishedStanley::command(const DriveState& state, double /*stamp_s*/, double /*now_s*/) {
  const Eigen::Vector2d front = state.T_world_base * Eigen::Vector2d(params_.wheelbase_m, 0.0);
  arc_m_ = path_.nearestArc(front, arc_m_, arc_m_ + kNearSearch_m);
  finished_ = finished_ || path_.length_m() - arc_m_ < kArrived_m;
  if (finished_) return Twist::Zero();

  const double psi_rad = wrapRadians(path_.at(arc_m_).heading_rad - state.heading_rad());
  const double error_m = -path_.leftOf(front, arc_m_);
  const double most_rad = kRadPerDeg * params_.max_steering_deg;
  const double steering_rad =
      std::clamp(psi_rad + std::atan2(params_.gain_per_s * error_m, std::max(0.0, state.twist.x())),
                 -most_rad, most_rad);
  return steeredTwist(params_.speed_m_per_s, steering_rad, params_.wheelbase_m);
}

double PublishedPid::update(double wanted, double measured, double period_s) {
  const double error = wanted - measured;
  if (last_error_ && error * *last_error_ < 0.0) integral_ = 0.0;
  const double change = (last_error_.value_or(error) - error) / period_s;  // the wrong sign
  last_error_ = error;
  const auto limited = [this](double term) { return std::clamp(term, -params_.max_term, params_.max_term); };
  integral_ = limited(integral_ + params_.integral_per_s * error * period_s);
  output_ += limited(params_.proportional * error) + integral_ + limited(params_.derivative_s * change);
  output_ = std::clamp(output_, params_.min_output, params_.max_output);
  return output_;
}

}  // namespace stereo_nav::control
