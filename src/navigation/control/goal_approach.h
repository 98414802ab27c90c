#pragma once

#include "navigation/control/speed_profile.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::control {

/// What counts as arrived, and how a base turns on the spot.
struct GoalParams {
  double position_tolerance_m = 0.015;
  double heading_tolerance_deg = 1.5;
  /// A base that can turn on the spot does so before it follows a path that begins in a direction further
  /// off.
  double turn_on_spot_above_deg = 30.0;
  double turn_gain_per_s = 4.0;

  void describe(ParameterVisitor& visitor);
};

/// Whether a goal is reached. Each part is latched: noise of the position while the base turns to the heading
/// does not send it off again.
class GoalCheck {
 public:
  explicit GoalCheck(const GoalParams& params) : params_(params) {}

  /// Distance and heading error of the base. True once both have been within their tolerances, the heading
  /// when the position was already.
  bool update(double distance_m, double heading_error_rad);

  bool positionReached() const { return position_reached_; }
  bool reached() const { return reached_; }

 private:
  GoalParams params_;
  bool position_reached_ = false;
  bool reached_ = false;
};

/// The turning rate from which a base can still stop at a heading that is `error_rad` away, with the sign of
/// the error.
double turnRateTowards(double error_rad, const GoalParams& goal, const SpeedLimits& limits);

}  // namespace stereo_nav::control
