#include "sensors/base/emulation/emulated_wheel.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::base {

void EmulatedWheel::advance(double duty, double steering_rad, double duration_s) {
  const double pushing = std::max(0.0, std::abs(duty) - params_.friction_duty);
  const double final_m_per_s = std::copysign(pushing * params_.full_speed_m_per_s, duty);
  const double limit = params_.max_acceleration_m_per_s2 * duration_s;
  const double change = (final_m_per_s - speed_m_per_s_) * -std::expm1(-duration_s / params_.lag_s);
  const double speed_before = speed_m_per_s_;
  speed_m_per_s_ += std::clamp(change, -limit, limit);
  way_m_ += 0.5 * (speed_before + speed_m_per_s_) * duration_s;
  if (!params_.steered) return;
  const double turn = params_.steering_rate_rad_per_s * duration_s;
  steering_rad_ += std::clamp(steering_rad - steering_rad_, -turn, turn);
}

std::int32_t EmulatedWheel::pulses() const {
  const auto count = static_cast<std::int64_t>(std::floor(way_m_ / params_.metres_per_pulse));
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(count));
}

}  // namespace stereo_nav::base
