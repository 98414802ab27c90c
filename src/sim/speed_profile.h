#pragma once

#include <functional>
#include <vector>

namespace stereo_nav::sim {

/// Limits of a drive along a curve; all > 0.
struct SpeedLimits {
  double speed_m_s;
  double acceleration_mps2;
  double yaw_rate_rps;
  double variation;  ///< share by which the speed wavers
};

/// Distance travelled over time along a curve, from rest to rest. The speed is the highest that the limits
/// allow, smoothed so that the acceleration is continuous.
class SpeedProfile {
 public:
  /// `curvature(arc_m)` in 1/m, for arc lengths 0 to `length_m`.
  SpeedProfile(double length_m, const std::function<double(double)>& curvature, const SpeedLimits& limits);

  double duration_s() const;
  double arc_m(double time_s) const;
  double speed_m_s(double time_s) const;
  /// When the distance reaches `arc_m`.
  double timeOf(double arc_m) const;

 private:
  static constexpr double kStep_s = 0.01;

  std::vector<double> speed_m_s_, arc_m_;  ///< at multiples of kStep_s
};

}  // namespace stereo_nav::sim
