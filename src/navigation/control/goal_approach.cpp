#include "navigation/control/goal_approach.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"

namespace stereo_nav::control {

void GoalParams::describe(ParameterVisitor& visitor) {
  visitor.real("position_tolerance_m", position_tolerance_m, {0.001, 5.0}, "m",
               "distance that counts as arrived");
  visitor.real("heading_tolerance_deg", heading_tolerance_deg, {0.1, 360.0}, "deg",
               "error of the heading that counts as arrived");
  visitor.real("turn_on_spot_above_deg", turn_on_spot_above_deg, {1.0, 360.0}, "deg",
               "a base that can turns on the spot before a path that begins further off its heading");
  visitor.real("turn_gain_per_s", turn_gain_per_s, {0.1, 20.0}, "1/s",
               "turning rate on the spot for each radian that is left");
}

bool GoalCheck::update(double distance_m, double heading_error_rad) {
  position_reached_ = position_reached_ || distance_m <= params_.position_tolerance_m;
  reached_ = reached_ ||
             (position_reached_ && std::abs(heading_error_rad) <= kRadPerDeg * params_.heading_tolerance_deg);
  return reached_;
}

double turnRateTowards(double error_rad, const GoalParams& goal, const SpeedLimits& limits) {
  const double left_rad = std::abs(error_rad);
  // Half of the acceleration that is allowed: the other half corrects.
  const double braking = std::sqrt(limits.max_turn_acceleration_rad_per_s2 * left_rad);
  const double rate = std::min({limits.max_turn_rate_rad_per_s, goal.turn_gain_per_s * left_rad, braking});
  return std::copysign(rate, error_rad);
}

}  // namespace stereo_nav::control
