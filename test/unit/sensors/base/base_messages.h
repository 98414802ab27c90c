#pragma once

#include <cstdint>
#include <vector>

#include "sensors/base/controller/frame_parser.h"
#include "sensors/base/crc32.h"

namespace stereo_nav::base {

using Bytes = std::vector<std::uint8_t>;

inline void append(Bytes& to, const Bytes& bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

/// Telemetry of a base with four steered wheels, a servo, two range finders and a motor; its numbers follow
/// from k.
inline Telemetry telemetryOf(std::uint32_t k) {
  Telemetry t{};
  t.sequence = static_cast<std::uint16_t>(k);
  t.time_us = 10000 * k;
  t.command_sequence = static_cast<std::uint16_t>(3 * k);
  t.mode = static_cast<std::uint8_t>(Mode::kDriving);
  t.switches = static_cast<std::uint16_t>(k % 5);
  t.battery_mV = 12000;
  t.wheels = 4;
  t.joints = 1;
  t.ranges = 2;
  t.actuators = 1;
  for (int i = 0; i < 4; ++i) {
    t.pulses[i] = static_cast<std::int32_t>(k) * (i - 1);
    t.steering_urad[i] = 1000 * i - 1500;
    t.target_mm_per_s[i] = static_cast<std::int16_t>(100 * i - 150);
  }
  t.joint_urad[0] = -700000;
  t.range_mm[0] = 1234;
  t.range_mm[1] = kRangeNothing;
  t.actuator_permille[0] = -250;
  return t;
}

inline Command commandOf(std::uint32_t k) {
  Command c{};
  c.sequence = static_cast<std::uint16_t>(k);
  c.valid_ms = 300;
  c.wheels = 4;
  c.joints = 1;
  c.actuators = 1;
  for (int i = 0; i < 4; ++i) {
    c.speed_mm_per_s[i] = static_cast<std::int16_t>(200 * i - 300 + static_cast<int>(k % 7));
    c.steering_urad[i] = -1000 * i;
  }
  c.joint_urad[0] = 700000;
  c.actuator_permille[0] = 1000;
  return c;
}

template <class Message>
Bytes encoded(const Message& message) {
  Bytes frame(maxFrameBytes<Message>());
  frame.resize(encode<Crc32>(message, frame.data()));
  return frame;
}

template <class Message>
std::vector<Message> parse(FrameParser<Message, Crc32>& parser, const Bytes& bytes) {
  std::vector<Message> found;
  Message message{};
  for (const std::uint8_t byte : bytes) {
    if (parser.push(byte, message)) found.push_back(message);
  }
  return found;
}

}  // namespace stereo_nav::base
