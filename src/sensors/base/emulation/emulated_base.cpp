#include "sensors/base/emulation/emulated_base.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::base {
namespace {

/// Step of the wheels' motion.
constexpr double kStep_s = 0.001;

SpeedLoopGains gainsFor(const EmulatedWheelParams& wheel) {
  SpeedLoopGains gains{};
  gains.duty_per_speed = static_cast<float>(1.0 / wheel.full_speed_m_per_s);
  gains.friction_duty = static_cast<float>(wheel.friction_duty);
  gains.proportional = 1.5F;
  gains.integral = 3.0F;
  gains.back_calculation = 10.0F;
  return gains;
}

SteeringLoopGains steeringGainsFor(const EmulatedWheelParams& wheel) {
  SteeringLoopGains gains{};
  gains.rate_per_error = 15.0F;
  gains.max_rate_rad_per_s = static_cast<float>(0.8 * wheel.steering_rate_rad_per_s);
  gains.tolerance_rad = 0.002F;
  gains.rate.duty_per_speed = static_cast<float>(1.0 / wheel.steering_rate_rad_per_s);
  gains.rate.friction_duty = static_cast<float>(wheel.friction_duty);
  gains.rate.proportional = 0.1F;
  gains.rate.integral = 2.0F;
  gains.rate.back_calculation = 10.0F;
  return gains;
}

ControllerSetup setupFor(const EmulatedBaseParams& params) {
  ControllerSetup setup{};
  setup.wheels = static_cast<std::uint8_t>(params.wheels.size());
  setup.joints = static_cast<std::uint8_t>(params.joints);
  setup.ranges = static_cast<std::uint8_t>(params.ranges_mm.size());
  setup.actuators = static_cast<std::uint8_t>(params.actuators);
  for (std::size_t i = 0; i < params.wheels.size(); ++i) {
    setup.metres_per_pulse[i] = static_cast<float>(params.wheels[i].metres_per_pulse);
    setup.is_steered[i] = params.wheels[i].steered;
  }
  if (params.wheels.empty()) return setup;
  setup.gains = gainsFor(params.wheels.front());
  setup.steering_gains = steeringGainsFor(params.wheels.front());
  return setup;
}

std::uint32_t milliseconds(double time_s) {
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(std::llround(1e3 * time_s)));
}

}  // namespace

EmulatedBase::EmulatedBase(const EmulatedBaseParams& params)
    : params_(params), controller_(setupFor(params)), wheels_(params.wheels.begin(), params.wheels.end()) {}

void EmulatedBase::receive(std::uint8_t byte) {
  controller_.receive(byte, milliseconds(time_s_));
}

void EmulatedBase::advance(double time_s, const Sink& sink) {
  while (static_cast<double>(periods_) * params_.period_s <= time_s) {
    runPeriod(sink);
  }
  time_s_ = std::max(time_s_, time_s);
}

/// Loops first, then the wheels turn for a period with what the loops gave out.
void EmulatedBase::runPeriod(const Sink& sink) {
  time_s_ = std::max(time_s_, static_cast<double>(periods_++) * params_.period_s);
  const ControllerInputs inputs = measure();
  outputs_ = controller_.step(inputs, milliseconds(time_s_), static_cast<float>(params_.period_s));
  std::vector<std::uint8_t> frame(maxFrameBytes<Telemetry>());
  const auto now_us = static_cast<std::uint32_t>(static_cast<std::uint64_t>(std::llround(1e6 * time_s_)));
  frame.resize(controller_.telemetry(inputs, now_us, frame.data()));
  sink(frame, time_s_);
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    for (double done_s = 0.0; done_s < params_.period_s - 0.5 * kStep_s; done_s += kStep_s)
      wheels_[i].advance(outputs_.duty[i], outputs_.steering_duty[i], kStep_s);
  }
}

ControllerInputs EmulatedBase::measure() const {
  ControllerInputs inputs{};
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    inputs.pulses[i] = wheels_[i].pulses();
    inputs.steering_urad[i] = static_cast<std::int32_t>(std::lround(1e6 * wheels_[i].steering_rad()));
  }
  std::copy(std::begin(outputs_.joint_urad), std::end(outputs_.joint_urad), inputs.joint_urad);
  std::copy(params_.ranges_mm.begin(), params_.ranges_mm.end(), inputs.range_mm);
  inputs.switches = params_.switches;
  inputs.battery_mV = params_.battery_mV;
  return inputs;
}

}  // namespace stereo_nav::base
