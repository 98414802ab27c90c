#pragma once

#include <cstdint>

namespace stereo_nav::base {

/// Motor, gear, tyre and encoder of one wheel.
struct EmulatedWheelParams {
  bool steered = false;
  double metres_per_pulse = 0.0005;
  double full_speed_m_per_s = 2.0;         ///< at full duty, after a long time
  double friction_duty = 0.05;             ///< duty that just turns the wheel
  double lag_s = 0.05;                     ///< time constant from duty to speed
  double max_acceleration_m_per_s2 = 3.0;  ///< what the tyre transmits
  double steering_rate_rad_per_s = 12.0;   ///< of the steered axis at full duty, after a long time
  double steering_lag_s = 0.03;            ///< time constant from duty to rate
};

/// A direct-current motor as a first-order lag whose acceleration is limited, and one that steers.
class EmulatedWheel {
 public:
  explicit EmulatedWheel(const EmulatedWheelParams& params) : params_(params) {}

  /// Both duties from -1 to 1.
  void advance(double duty, double steering_duty, double duration_s);

  double speed_m_per_s() const { return speed_m_per_s_; }
  double way_m() const { return way_m_; }
  double steering_rad() const { return steering_rad_; }
  /// The counter, which wraps.
  std::int32_t pulses() const;

 private:
  EmulatedWheelParams params_;
  double speed_m_per_s_ = 0.0;
  double way_m_ = 0.0;
  double steering_rad_ = 0.0;
  double steering_rate_rad_per_s_ = 0.0;
};

}  // namespace stereo_nav::base
