#include "navigation/control/pid.h"

#include <algorithm>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::control {

void PidParams::describe(ParameterVisitor& visitor) {
  visitor.real("feed_forward", feed_forward, {-1e6, 1e6}, "", "output for each unit of the wanted value");
  visitor.real("proportional", proportional, {-1e6, 1e6}, "", "output for each unit of error");
  visitor.real("integral_per_s", integral_per_s, {-1e6, 1e6}, "1/s",
               "change of the output in a second for each unit of error");
  visitor.real("derivative_s", derivative_s, {-1e6, 1e6}, "s",
               "output against each unit a second of the measurement");
  visitor.real("derivative_filter_s", derivative_filter_s, {0.0, 10.0}, "s",
               "time constant of the low-pass before the derivative");
  visitor.real("min_output", min_output, {-1e6, 1e6}, "", "least output");
  visitor.real("max_output", max_output, {-1e6, 1e6}, "", "largest output");
  visitor.real("back_calculation_s", back_calculation_s, {0.0, 100.0}, "s",
               "time constant with which the integral gives way at a limit; 0: within one period");
}

Pid::Pid(const PidParams& params) : params_(params) {
  validateParameters(params, "PID");
  if (params.min_output >= params.max_output)
    throw ParameterError("PID: min_output is not below max_output; nothing could be put out");
}

void Pid::reset() {
  integral_ = 0.0;
  first_ = true;
}

double Pid::update(double wanted, double measured, double period_s) {
  if (first_) filtered_ = measured;
  first_ = false;
  const double before = filtered_;
  filtered_ += (measured - filtered_) * period_s / (params_.derivative_filter_s + period_s);
  const double rate = (filtered_ - before) / period_s;
  const double error = wanted - measured;

  const double free_output =
      params_.feed_forward * wanted + params_.proportional * error + integral_ - params_.derivative_s * rate;
  const double output = std::clamp(free_output, params_.min_output, params_.max_output);
  integral_ += params_.integral_per_s * error * period_s;
  // The time constant is never below a period: the integral would be wound back past its mark.
  integral_ += (output - free_output) * period_s / std::max(params_.back_calculation_s, period_s);
  return output;
}

}  // namespace stereo_nav::control
