#include "kinematics/wheel_commander.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::kinematics {

void WheelLimits::describe(ParameterVisitor& visitor) {
  visitor.real("max_speed_m_per_s", max_speed_m_per_s, {1e-3, 100.0}, "m/s",
               "largest speed of a wheel's circumference");
  visitor.real("max_acceleration_m_per_s2", max_acceleration_m_per_s2, {1e-3, 1000.0}, "m/s^2",
               "largest change of a wheel's speed");
  visitor.real("max_steering_rate_rad_per_s", max_steering_rate_rad_per_s, {1e-3, 1000.0}, "rad/s",
               "largest rate of a steering axis");
  visitor.real("idle_speed_m_per_s", idle_speed_m_per_s, {0.0, 1.0}, "m/s",
               "a steered wheel that is slower than this keeps its angle");
}

Twist desaturated(const Drive& drive, const Twist& twist, double max_speed_m_per_s) {
  const Twist possible = drive.nearestPossible(twist);
  double fastest = 0.0;
  for (const auto& wheel : drive.inverse(possible))
    fastest = std::max(fastest, std::abs(wheel.speed_m_per_s));
  return fastest > max_speed_m_per_s ? Twist(possible * (max_speed_m_per_s / fastest)) : possible;
}

WheelState leastSteering(const WheelState& wanted, double current_rad) {
  const double turn_rad = wrapRadians(wanted.steering_rad - current_rad);
  // At 90 degrees both ways are equally long: the one without a change of sign is taken.
  if (std::abs(turn_rad) <= 0.5 * kPi + 1e-12) return {wanted.speed_m_per_s, current_rad + turn_rad};
  return {-wanted.speed_m_per_s, current_rad + wrapRadians(turn_rad + kPi)};
}

WheelCommander::WheelCommander(const DriveParams& drive, const WheelLimits& limits)
    : drive_(drive), limits_(limits), last_(drive.wheels.size()) {
  validateParameters(drive, "drive");
  validateParameters(limits, "wheel limits");
}

void WheelCommander::halt() {
  for (auto& wheel : last_) wheel.speed_m_per_s = 0.0;
}

std::vector<WheelState> WheelCommander::command(const Twist& twist, double period_s) {
  std::vector<double> steering_rad;
  for (const auto& wheel : last_) steering_rad.push_back(wheel.steering_rad);
  return command(twist, period_s, steering_rad);
}

std::vector<WheelState> WheelCommander::command(const Twist& twist, double period_s,
                                                const std::vector<double>& steering_rad) {
  auto wheels = drive_.inverse(desaturated(drive_, alongArc(twist, period_s), limits_.max_speed_m_per_s));
  const double most_steering_rad = limits_.max_steering_rate_rad_per_s * period_s;
  const double most_change = limits_.max_acceleration_m_per_s2 * period_s;
  double share = 1.0;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    WheelState& wheel = wheels[i];
    if (drive_.steered(i)) {
      const double current_rad = steering_rad[i];
      const bool idle = std::abs(wheel.speed_m_per_s) < limits_.idle_speed_m_per_s;
      const bool endless = drive_.params().wheels[i].max_steering_deg >= 180.0;
      if (idle) wheel = {0.0, last_[i].steering_rad};
      if (!idle && endless) wheel = leastSteering(wheel, current_rad);
      // Scaled by the error that is left when the period begins: a wheel across its way must not push.
      wheel.speed_m_per_s *= std::max(0.0, std::cos(wheel.steering_rad - current_rad));
      wheel.steering_rad =
          std::clamp(wheel.steering_rad, current_rad - most_steering_rad, current_rad + most_steering_rad);
    }
    const double change = std::abs(wheel.speed_m_per_s - last_[i].speed_m_per_s);
    if (change > most_change) share = std::min(share, most_change / change);
  }
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const double from = last_[i].speed_m_per_s;
    wheels[i].speed_m_per_s = from + share * (wheels[i].speed_m_per_s - from);
  }
  last_ = wheels;
  return wheels;
}

}  // namespace stereo_nav::kinematics
