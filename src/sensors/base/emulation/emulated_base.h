#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sensors/base/controller/base_controller.h"
#include "sensors/base/emulation/emulated_wheel.h"

namespace stereo_nav::base {

struct EmulatedBaseParams {
  std::vector<EmulatedWheelParams> wheels;
  int joints = 0;
  std::vector<std::uint16_t> ranges_mm;  ///< what the range finders see, constant
  int actuators = 0;
  std::uint16_t switches = 0;
  std::uint16_t battery_mV = 12400;
  double period_s = 0.01;  ///< of the loops and of the telemetry
};

/// A base whose microcontroller runs the code of src/sensors/base/controller against imitated wheels.
/// Joints are servos that are at once where they are told to be.
class EmulatedBase {
 public:
  using Sink = std::function<void(const std::vector<std::uint8_t>& frame, double time_s)>;

  explicit EmulatedBase(const EmulatedBaseParams& params);

  /// A byte from the host, at the time up to which the base was advanced.
  void receive(std::uint8_t byte);
  /// Lets time pass and hands over the frames of telemetry that fall due.
  void advance(double time_s, const Sink& sink);

  const BaseController& controller() const { return controller_; }
  const std::vector<EmulatedWheel>& wheels() const { return wheels_; }
  const ControllerOutputs& outputs() const { return outputs_; }

 private:
  void runPeriod(const Sink& sink);
  ControllerInputs measure() const;

  EmulatedBaseParams params_;
  BaseController controller_;
  std::vector<EmulatedWheel> wheels_;
  ControllerOutputs outputs_{};
  std::uint64_t periods_ = 0;
  double time_s_ = 0.0;
};

}  // namespace stereo_nav::base
