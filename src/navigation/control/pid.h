#pragma once

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::control {

/// Gains of a loop of speed, distance or angle. The unit of the output a unit of the input is the unit of
/// `proportional`; the defaults are those of the speed loop that docs/driving.md measures.
struct PidParams {
  double feed_forward = 1.0;  ///< output a unit of the wanted value
  double proportional = 1.5;
  double integral_per_s = 10.0;
  double derivative_s = 0.0;
  double derivative_filter_s = 0.02;  ///< time constant of the low-pass before the derivative
  double min_output = -1.0;
  double max_output = 1.0;
  /// Time constant with which the integral gives way while the output is at a limit; 0: within one period.
  double back_calculation_s = 0.03;

  void describe(ParameterVisitor& visitor);
};

/// PID with feed-forward. The derivative is that of the measurement, so that a step of the wanted value gives
/// no kick; at a limit the integral is wound back by what the output was cut (back-calculation: Astrom and
/// Hagglund 1995, "PID Controllers", section 3.5).
class Pid {
 public:
  explicit Pid(const PidParams& params);

  /// One period: the output, within its limits.
  double update(double wanted, double measured, double period_s);
  /// Forgets integral and derivative.
  void reset();

 private:
  PidParams params_;
  double integral_ = 0.0;
  double filtered_ = 0.0;  ///< measurement behind the low-pass
  bool first_ = true;
};

}  // namespace stereo_nav::control
