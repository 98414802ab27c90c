#include "sim/lamp_flicker.h"

#include <cmath>

#include "core/angles.h"

namespace stereo_nav::sim {

double lampLight(const FlickerParams& flicker, double phase_rad, double middle_s, double exposure_s) {
  if (flicker.mains_hz <= 0.0) return 1.0;
  const double rate_rad_s = 2.0 * kPi * 2.0 * flicker.mains_hz;
  const double half_rad = 0.5 * rate_rad_s * exposure_s;
  const double left_over = half_rad > 1e-9 ? std::sin(half_rad) / half_rad : 1.0;
  return 1.0 + flicker.depth * left_over * std::cos(rate_rad_s * middle_s + phase_rad);
}

void FlickerParams::describe(ParameterVisitor& visitor) {
  visitor.real("mains_hz", mains_hz, {0.0, 1000.0}, "Hz",
               "frequency of the mains: 50 or 60; the lamps flicker twice as often; 0: steady light");
  visitor.real("depth", depth, {0.0, 1.0}, "", "amplitude of the lamps' light as a share of its mean");
}

}  // namespace stereo_nav::sim
