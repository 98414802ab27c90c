#pragma once

// Compiled by the controller, and by the host for its tests and the emulator: C++11, no library.

#include "command_watch.h"
#include "frame_parser.h"
#include "small_crc32.h"
#include "speed_loop.h"
#include "steering_loop.h"

namespace stereo_nav {
namespace base {

/// What the controller must know of its base.
struct ControllerSetup {
  uint8_t wheels, joints, ranges, actuators;
  float metres_per_pulse[kMaxWheels];  ///< of the circumference; negative where the encoder counts backwards
  bool is_steered[kMaxWheels];
  SpeedLoopGains gains;
  SteeringLoopGains steering_gains;
};

/// What is measured before a period.
struct ControllerInputs {
  int32_t pulses[kMaxWheels];
  int32_t steering_urad[kMaxWheels];
  int32_t joint_urad[kMaxJoints];
  uint16_t range_mm[kMaxRanges];
  uint16_t switches;
  uint16_t battery_mV;
};

/// What the motors do in the coming period.
struct ControllerOutputs {
  float duty[kMaxWheels];           ///< -1 to 1
  float steering_duty[kMaxWheels];  ///< of the steered axes, -1 to 1; 0 for wheels that are not steered
  int32_t joint_urad[kMaxJoints];
  int16_t actuator_permille[kMaxActuators];
};

/// All that the microcontroller does between its pins and its serial line. The emulator runs the same code.
class BaseController {
 public:
  explicit BaseController(const ControllerSetup& setup) : setup_(setup) {
    for (uint8_t i = 0; i < kMaxWheels; ++i) {
      loops_[i] = SpeedLoop(setup.gains);
      steering_loops_[i] = SteeringLoop(setup.steering_gains);
    }
  }

  /// A byte of the serial line.
  void receive(uint8_t byte, uint32_t now_ms) {
    if (!parser_.push(byte, received_)) return;
    const bool fits = received_.wheels == setup_.wheels && received_.joints == setup_.joints &&
                      received_.actuators == setup_.actuators;
    // What is meant for another base moves nothing here, but a stop is a stop.
    if (!fits && (received_.flags & kStop) == 0) return;
    if (!fits) received_.valid_ms = 0;
    watch_.accept(received_, now_ms);
    if (fits) command_ = received_;
    accepted_sequence_ = received_.sequence;
  }

  /// One period of the loops.
  const ControllerOutputs& step(const ControllerInputs& inputs, uint32_t now_ms, float period_s) {
    watch_.step(now_ms);
    if (!watch_.linkIsUp()) parser_.forgetSequence();  // the next host begins to count anew
    const bool drives = watch_.mode() == Mode::kDriving;
    const bool acts = watch_.linkIsUp() && watch_.mode() != Mode::kStopped;
    for (uint8_t i = 0; i < setup_.wheels; ++i) {
      target_mm_per_s_[i] = drives ? command_.speed_mm_per_s[i] : 0;
      const int32_t turned = knows_pulses_ ? static_cast<int32_t>(static_cast<uint32_t>(inputs.pulses[i]) -
                                                                  static_cast<uint32_t>(pulses_[i]))
                                           : 0;
      const float speed_m_per_s = static_cast<float>(turned) * setup_.metres_per_pulse[i] / period_s;
      outputs_.duty[i] = loops_[i].step(1e-3F * target_mm_per_s_[i], speed_m_per_s, period_s);
      pulses_[i] = inputs.pulses[i];
    }
    knows_pulses_ = true;
    steer(inputs, drives, period_s);
    // Joints hold their angles without a command; actuators, which are levels of motors, rest.
    for (uint8_t i = 0; i < setup_.joints && acts; ++i) outputs_.joint_urad[i] = command_.joint_urad[i];
    for (uint8_t i = 0; i < setup_.actuators; ++i)
      outputs_.actuator_permille[i] = acts ? command_.actuator_permille[i] : 0;
    return outputs_;
  }

  /// Writes a frame (at most maxFrameBytes<Telemetry>()) and returns its length.
  size_t telemetry(const ControllerInputs& inputs, uint32_t now_us, uint8_t* frame) {
    Telemetry& t = telemetry_;
    t.sequence = sequence_++;
    t.time_us = now_us;
    t.command_sequence = accepted_sequence_;
    t.mode = static_cast<uint8_t>(watch_.mode());
    t.switches = inputs.switches;
    t.battery_mV = inputs.battery_mV;
    t.bad_commands = static_cast<uint16_t>(parser_.counters().bad_crc + parser_.counters().impossible);
    t.lost_commands = static_cast<uint16_t>(parser_.counters().lost);
    t.wheels = setup_.wheels;
    t.joints = setup_.joints;
    t.ranges = setup_.ranges;
    t.actuators = setup_.actuators;
    memcpy(t.pulses, inputs.pulses, sizeof t.pulses);
    memcpy(t.steering_urad, inputs.steering_urad, sizeof t.steering_urad);
    memcpy(t.target_mm_per_s, target_mm_per_s_, sizeof t.target_mm_per_s);
    memcpy(t.joint_urad, inputs.joint_urad, sizeof t.joint_urad);
    memcpy(t.range_mm, inputs.range_mm, sizeof t.range_mm);
    memcpy(t.actuator_permille, outputs_.actuator_permille, sizeof t.actuator_permille);
    return encode<SmallCrc32>(t, frame);
  }

  Mode mode() const { return watch_.mode(); }
  /// The speed that the loop of a wheel holds since the last step().
  int16_t heldSpeed_mm_per_s(uint8_t wheel) const { return target_mm_per_s_[wheel]; }

 private:
  /// A steered axis that is not commanded is held where it was when the commands ended.
  void steer(const ControllerInputs& inputs, bool drives, float period_s) {
    for (uint8_t i = 0; i < setup_.wheels; ++i) {
      if (drives) {
        steering_target_urad_[i] = command_.steering_urad[i];
      } else if (steered_ || !knows_steering_) {
        steering_target_urad_[i] = inputs.steering_urad[i];
      }
      outputs_.steering_duty[i] =
          setup_.is_steered[i]
              ? steering_loops_[i].step(steering_target_urad_[i], inputs.steering_urad[i], period_s)
              : 0.0F;
    }
    steered_ = drives;
    knows_steering_ = true;
  }

  ControllerSetup setup_;
  FrameParser<Command, SmallCrc32> parser_;
  CommandWatch watch_;
  SpeedLoop loops_[kMaxWheels];
  SteeringLoop steering_loops_[kMaxWheels];
  Command received_ = Command();
  Command command_ = Command();
  ControllerOutputs outputs_ = ControllerOutputs();
  Telemetry telemetry_ = Telemetry();
  int16_t target_mm_per_s_[kMaxWheels] = {};
  int32_t pulses_[kMaxWheels] = {};
  bool knows_pulses_ = false;
  int32_t steering_target_urad_[kMaxWheels] = {};
  bool knows_steering_ = false;
  bool steered_ = false;  ///< the last period's angles were commanded
  uint16_t sequence_ = 0;
  uint16_t accepted_sequence_ = 0;
};

}  // namespace base
}  // namespace stereo_nav
