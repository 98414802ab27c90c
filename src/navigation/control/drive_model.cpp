#include "navigation/control/drive_model.h"

#include <algorithm>
#include <cmath>

#include "core/planar_motion.h"

namespace stereo_nav::control {
namespace {

constexpr double kStep_s = 0.005;
constexpr double kSlowest_m_per_s = 1e-6;  ///< below it a twist says nothing of a steering angle
constexpr double kForgetAfter_s = 1.0;
constexpr double kRounding_s = 1e-9;

/// How fast `value` moves to `wanted` with this lag.
template <class Value>
Value approach(const Value& value, const Value& wanted, double lag_s) {
  return (wanted - value) / lag_s;
}

void advanceBody(const DriveModelParams& params, const Twist& command, double step_s, Twist& twist) {
  Eigen::Vector2d acceleration =
      approach<Eigen::Vector2d>(twist.head<2>(), command.head<2>(), std::max(params.lag_s, step_s));
  if (acceleration.norm() > params.max_acceleration_m_per_s2)
    acceleration *= params.max_acceleration_m_per_s2 / acceleration.norm();
  const double most = params.max_turn_acceleration_rad_per_s2;
  twist.head<2>() += step_s * acceleration;
  twist.z() +=
      step_s * std::clamp(approach(twist.z(), command.z(), std::max(params.lag_s, step_s)), -most, most);
}

void advanceSteered(const DriveModelParams& params, const Twist& command, double step_s, DriveState& state) {
  const double wanted_rad = steeringOf(command, params.wheelbase_m, state.steering_rad);
  const double most_rate = params.max_steering_rate_rad_per_s;
  const double most = params.max_acceleration_m_per_s2;
  const double rate = approach(state.steering_rad, wanted_rad, std::max(params.steering_lag_s, step_s));
  const double acceleration = approach(state.twist.x(), command.x(), std::max(params.lag_s, step_s));
  state.steering_rad += step_s * std::clamp(rate, -most_rate, most_rate);
  const double speed = state.twist.x() + step_s * std::clamp(acceleration, -most, most);
  state.twist = steeredTwist(speed, state.steering_rad, params.wheelbase_m);
}

}  // namespace

void DriveModelParams::describe(ParameterVisitor& visitor) {
  visitor.real("dead_time_s", dead_time_s, {0.0, 1.0}, "s", "from a command to the first motion by it");
  visitor.real("lag_s", lag_s, {0.0, 2.0}, "s", "time constant with which the velocity follows");
  visitor.real("max_acceleration_m_per_s2", max_acceleration_m_per_s2, {0.01, 100.0}, "m/s^2",
               "largest change of the velocity");
  visitor.real("max_turn_acceleration_rad_per_s2", max_turn_acceleration_rad_per_s2, {0.01, 1000.0},
               "rad/s^2", "largest change of the turning rate");
  visitor.real("wheelbase_m", wheelbase_m, {0.0, 10.0}, "m",
               "between the axles of a vehicle with steered front wheels; 0 for every other base");
  visitor.real("steering_lag_s", steering_lag_s, {0.0, 2.0}, "s",
               "time constant with which the steering angle follows");
  visitor.real("max_steering_rate_rad_per_s", max_steering_rate_rad_per_s, {0.01, 100.0}, "rad/s",
               "fastest steering");
}

double DriveState::heading_rad() const {
  return std::atan2(T_world_base.linear()(1, 0), T_world_base.linear()(0, 0));
}

double steeringOf(const Twist& twist, double wheelbase_m, double otherwise_rad) {
  if (std::abs(twist.x()) < kSlowest_m_per_s) return otherwise_rad;
  return std::atan(wheelbase_m * twist.z() / twist.x());
}

Twist steeredTwist(double speed_m_per_s, double steering_rad, double wheelbase_m) {
  return {speed_m_per_s, 0.0, speed_m_per_s * std::tan(steering_rad) / wheelbase_m};
}

DriveState advanced(const DriveModelParams& params, DriveState state, const Twist& command,
                    double duration_s) {
  const int steps = std::max(1, static_cast<int>(std::ceil(duration_s / kStep_s - kRounding_s)));
  const double step_s = duration_s / steps;
  if (!(step_s > 0.0)) return state;
  for (int i = 0; i < steps; ++i) {
    if (params.steered()) {
      advanceSteered(params, command, step_s, state);
    } else {
      advanceBody(params, command, step_s, state.twist);
    }
    state.T_world_base = state.T_world_base * expPlanar(state.twist * step_s);
  }
  return state;
}

void CommandHistory::add(double time_s, const Twist& command) {
  commands_.push_back({time_s + params_.dead_time_s, command});
  while (commands_.size() > 1 && commands_[1].from_s < time_s - kForgetAfter_s) commands_.pop_front();
}

void CommandHistory::replaceLast(double time_s, const Twist& command) {
  if (!commands_.empty() && commands_.back().from_s >= time_s + params_.dead_time_s) commands_.pop_back();
  add(time_s, command);
}

DriveState CommandHistory::predicted(const DriveState& state, double stamp_s, double until_s) const {
  DriveState result = state;
  double from_s = stamp_s;
  Twist acting = Twist::Zero();
  for (const Entry& entry : commands_) {
    if (entry.from_s > until_s - kRounding_s) break;
    if (entry.from_s > from_s + kRounding_s) {
      result = advanced(params_, result, acting, entry.from_s - from_s);
      from_s = entry.from_s;
    }
    acting = entry.command;
  }
  return until_s > from_s ? advanced(params_, result, acting, until_s - from_s) : result;
}

}  // namespace stereo_nav::control
