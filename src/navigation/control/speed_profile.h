#pragma once

#include <optional>
#include <vector>

#include "kinematics/drive.h"
#include "navigation/control/path.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::control {

/// What a base may do on its way.
struct SpeedLimits {
  double max_speed_m_per_s = 1.0;
  double max_acceleration_m_per_s2 = 1.5;
  double max_braking_m_per_s2 = 1.5;
  double max_lateral_acceleration_m_per_s2 = 1.5;
  double max_turn_rate_rad_per_s = 4.0;
  double max_turn_acceleration_rad_per_s2 = 8.0;
  /// Near the end the speed falls with the distance that is left: so many m/s a metre.
  double end_gain_per_s = 3.0;

  void describe(ParameterVisitor& visitor);
};

/// The wheels that turn a speed of the base into speeds of their own.
struct WheelSpeedLimit {
  kinematics::Drive drive;
  double max_speed_m_per_s;
};

/// The highest speed at each place of a path: so that curves are taken within the lateral acceleration, the
/// turning rate and its change and the wheels' speeds, and that braking suffices for what comes and for the
/// end, where the base stands. Acceleration is not part of it: the base may come from any speed, and
/// SpeedGovernor accelerates it.
class PathSpeedProfile {
 public:
  /// `wheels`: for a base that turns with the path and moves along its own x axis.
  PathSpeedProfile(const Path& path, const SpeedLimits& limits,
                   const std::optional<WheelSpeedLimit>& wheels = std::nullopt);

  /// m/s, at an arc length that is held within the path.
  double limit(double arc_m) const;

 private:
  std::vector<double> arc_m_, squared_;  ///< m, (m/s)^2: linear in between for a constant acceleration
  double end_gain_per_s_;
};

/// The speed that is asked of the base, period by period: towards the limit, within acceleration and braking.
class SpeedGovernor {
 public:
  explicit SpeedGovernor(const SpeedLimits& limits) : limits_(limits) {}

  /// Starts from the speed that the base has.
  void reset(double speed_m_per_s) {
    speed_m_per_s_ = speed_m_per_s;
    acceleration_m_per_s2_ = 0.0;
  }

  /// The speed at the end of the coming period.
  double next(double limit_m_per_s, double period_s);

  double speed_m_per_s() const { return speed_m_per_s_; }
  /// m/s^2, over the period
  double acceleration() const { return acceleration_m_per_s2_; }

 private:
  SpeedLimits limits_;
  double speed_m_per_s_ = 0.0;
  double acceleration_m_per_s2_ = 0.0;
};

}  // namespace stereo_nav::control
