#include "sensors/base/emulation/emulated_wheel.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::base {

void EmulatedWheel::advance(double duty, double steering_duty, double duration_s) {
  const auto pushing = [this](double of) {
    return std::copysign(std::max(0.0, std::abs(of) - params_.friction_duty), of);
  };
  const double final_m_per_s = pushing(duty) * params_.full_speed_m_per_s;
  const double limit = params_.max_acceleration_m_per_s2 * duration_s;
  const double change = (final_m_per_s - speed_m_per_s_) * -std::expm1(-duration_s / params_.lag_s);
  const double speed_before = speed_m_per_s_;
  speed_m_per_s_ += std::clamp(change, -limit, limit);
  way_m_ += 0.5 * (speed_before + speed_m_per_s_) * duration_s;
  if (!params_.steered) return;
  const double rate_before = steering_rate_rad_per_s_;
  const double final_rad_per_s = pushing(steering_duty) * params_.steering_rate_rad_per_s;
  steering_rate_rad_per_s_ +=
      (final_rad_per_s - rate_before) * -std::expm1(-duration_s / params_.steering_lag_s);
  steering_rad_ += 0.5 * (rate_before + steering_rate_rad_per_s_) * duration_s;
}

std::int32_t EmulatedWheel::pulses() const {
  const auto count = static_cast<std::int64_t>(std::floor(way_m_ / params_.metres_per_pulse));
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(count));
}

}  // namespace stereo_nav::base
