#pragma once

// Compiled by the controller, and by the host for its tests and the emulator: C++11, no library.

namespace stereo_nav {
namespace base {

/// Gains of the speed loop of one wheel. A duty of 1 is the full voltage of the battery forwards.
struct SpeedLoopGains {
  float duty_per_speed;    ///< feed-forward: duty that holds 1 m/s, per m/s
  float friction_duty;     ///< feed-forward: duty that just turns the wheel
  float proportional;      ///< duty per m/s of error
  float integral;          ///< duty per m/s of error and second
  float back_calculation;  ///< 1/s: how fast the integral gives back what the limit of the duty cuts off
};

/// PI control with feed-forward, and back-calculation against the wind-up of the integral (Astrom, Hagglund:
/// PID Controllers, 1995, section 3.5).
class SpeedLoop {
 public:
  explicit SpeedLoop(const SpeedLoopGains& gains = SpeedLoopGains()) : gains_(gains), integral_(0.0F) {}

  /// Duty from -1 to 1 for the coming `period_s`.
  float step(float target_m_per_s, float measured_m_per_s, float period_s) {
    if (target_m_per_s == 0.0F && measured_m_per_s > -kStanding_m_per_s &&
        measured_m_per_s < kStanding_m_per_s) {
      integral_ = 0.0F;
      return 0.0F;
    }
    const float error = target_m_per_s - measured_m_per_s;
    const float wanted = feedForward(target_m_per_s) + gains_.proportional * error + integral_;
    const float duty = wanted > 1.0F ? 1.0F : wanted < -1.0F ? -1.0F : wanted;
    integral_ += (gains_.integral * error + gains_.back_calculation * (duty - wanted)) * period_s;
    return duty;
  }

  void reset() { integral_ = 0.0F; }

 private:
  /// A wheel that is to stand and is slower than this gets no current, so that it neither hums nor creeps.
  static constexpr float kStanding_m_per_s = 0.02F;

  float feedForward(float target_m_per_s) const {
    const float friction = target_m_per_s > 0.0F   ? gains_.friction_duty
                           : target_m_per_s < 0.0F ? -gains_.friction_duty
                                                   : 0.0F;
    return gains_.duty_per_speed * target_m_per_s + friction;
  }

  SpeedLoopGains gains_;
  float integral_;
};

}  // namespace base
}  // namespace stereo_nav
