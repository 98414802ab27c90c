#pragma once

// Compiled by the controller, and by the host for its tests and the emulator: C++11, no library.

#include <stdint.h>

#include "speed_loop.h"

namespace stereo_nav {
namespace base {

/// Gains of the angle loop of a steered axis.
struct SteeringLoopGains {
  float rate_per_error;      ///< 1/s: the error of the angle times this is the rate that the axis shall have
  float max_rate_rad_per_s;  ///< and at most this
  float tolerance_rad;       ///< within it the axis stands; above the step of the angle's sensor
  SpeedLoopGains rate;       ///< of the loop of the rate, with radians in place of metres
};

/// Cascade control of the angle of a steered axis: its error gives the rate that a speed loop holds, which
/// overcomes friction and does not wind up.
class SteeringLoop {
 public:
  explicit SteeringLoop(const SteeringLoopGains& gains = SteeringLoopGains())
      : gains_(gains), rate_loop_(gains.rate), knows_angle_(false), last_urad_(0) {}

  /// Duty from -1 to 1 for the coming `period_s`. Both angles are continuous beyond a turn.
  float step(int32_t target_urad, int32_t measured_urad, float period_s) {
    const float turned = knows_angle_ ? radians(measured_urad, last_urad_) : 0.0F;
    knows_angle_ = true;
    last_urad_ = measured_urad;
    return rate_loop_.step(wantedRate(radians(target_urad, measured_urad)), turned / period_s, period_s);
  }

 private:
  static float radians(int32_t to_urad, int32_t from_urad) {
    return 1e-6F * static_cast<float>(static_cast<int32_t>(static_cast<uint32_t>(to_urad) -
                                                           static_cast<uint32_t>(from_urad)));
  }

  float wantedRate(float error_rad) const {
    if (error_rad > -gains_.tolerance_rad && error_rad < gains_.tolerance_rad) return 0.0F;
    const float rate = gains_.rate_per_error * error_rad;
    return rate > gains_.max_rate_rad_per_s    ? gains_.max_rate_rad_per_s
           : rate < -gains_.max_rate_rad_per_s ? -gains_.max_rate_rad_per_s
                                               : rate;
  }

  SteeringLoopGains gains_;
  SpeedLoop rate_loop_;
  bool knows_angle_;
  int32_t last_urad_;
};

/// The continuous angle of an axis from an absolute sensor that begins again after each turn, read at least
/// twice a turn.
class TurnCounter {
 public:
  /// `counts`: 0 to counts_per_turn - 1; `zero`: those of an angle of zero. The first angle lies within half
  /// a turn of zero.
  int32_t angle_urad(uint16_t counts, uint16_t zero, uint16_t counts_per_turn) {
    const int32_t before = total_;
    const int32_t half = counts_per_turn / 2;
    int32_t turned = (static_cast<int32_t>(counts) - zero - before) % counts_per_turn;
    if (turned >= half) turned -= counts_per_turn;
    if (turned < -half) turned += counts_per_turn;
    total_ = before + turned;
    return static_cast<int32_t>(static_cast<int64_t>(total_) * 6283185 / counts_per_turn);
  }

 private:
  int32_t total_ = 0;
};

}  // namespace base
}  // namespace stereo_nav
