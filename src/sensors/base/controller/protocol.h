#pragma once

// The protocol between base_bridge and the microcontroller of a base. This header is compiled on both sides:
// C++11, no library beyond <stdint.h>, <stddef.h> and <string.h>.
//
// Both directions have the same frame, all numbers little-endian:
//
// | bytes | content |
// |---|---|
// | 2 | 0xB5 0x62 |
// | 1 | type: 1 telemetry (to the host), 2 command (to the controller) |
// | 1 | length n of the payload |
// | n | payload, which begins with the uint16 sequence; docs/base.md has the tables |
// | 4 | CRC-32 (IEEE 802.3, as zlib's) of type, length and payload |

#include <stddef.h>
#include <stdint.h>
#include <string.h>

namespace stereo_nav {
namespace base {

constexpr uint8_t kSync0 = 0xB5;
constexpr uint8_t kSync1 = 0x62;
constexpr size_t kPrefixBytes = 4;  ///< before the payload
constexpr size_t kCrcBytes = 4;     ///< behind the payload

constexpr uint8_t kMaxWheels = 8;
constexpr uint8_t kMaxJoints = 4;
constexpr uint8_t kMaxRanges = 8;
constexpr uint8_t kMaxActuators = 8;

/// A command is valid for at most this time, and a controller that hears none for as long stops.
constexpr uint16_t kMaxValid_ms = 300;

constexpr uint16_t kRangeTooNear = 0;       ///< something is nearer than the range finder can measure
constexpr uint16_t kRangeUnknown = 0xFFFE;  ///< the range finder is silent, failed, or was dazzled
constexpr uint16_t kRangeNothing = 0xFFFF;  ///< nothing is as near as the range finder can measure

/// What the controller does with its wheels.
enum class Mode : uint8_t {
  kWaiting = 0,   ///< it has had no command since it was switched on
  kDriving = 1,   ///< the wheels follow the commands
  kTimedOut = 2,  ///< the last command's time is over: the wheels are stopped
  kStopped = 3    ///< stopped until a command releases it
};

enum CommandFlags : uint8_t {
  kStop = 1,    ///< stop now, and stay stopped
  kRelease = 2  ///< end of kStop; of no effect in a frame with kStop
};

/// What the controller sends, at a fixed rate.
struct Telemetry {
  static constexpr uint8_t kType = 1;
  static constexpr size_t kMinPayload = 21;
  static constexpr size_t kMaxPayload =
      kMinPayload + 10 * kMaxWheels + 4 * kMaxJoints + 2 * kMaxRanges + 2 * kMaxActuators;

  uint16_t sequence;          ///< counts frames sent, wraps
  uint32_t time_us;           ///< the controller's clock when the counters were read; wraps
  uint16_t command_sequence;  ///< of the last command that was accepted
  uint8_t mode;               ///< a Mode
  uint16_t switches;          ///< bit i: switch i is pressed
  uint16_t battery_mV;        ///< 0: not measured
  uint16_t bad_commands;      ///< frames of commands that were damaged, since it was switched on; wraps
  uint16_t lost_commands;     ///< gaps in the sequence of the commands, likewise
  uint8_t wheels, joints, ranges, actuators;  ///< how many there are of what follows

  int32_t pulses[kMaxWheels];           ///< counters, which run on and wrap
  int32_t steering_urad[kMaxWheels];    ///< measured, counterclockwise, microradians; 0 for unsteered wheels
  int16_t target_mm_per_s[kMaxWheels];  ///< the speed that the wheel's loop holds now
  int32_t joint_urad[kMaxJoints];       ///< measured, or where it is not, commanded
  uint16_t range_mm[kMaxRanges];        ///< or kRangeTooNear, kRangeUnknown, kRangeNothing
  int16_t actuator_permille[kMaxActuators];  ///< level now, -1000 to 1000
};

/// What the host sends, at a fixed rate.
struct Command {
  static constexpr uint8_t kType = 2;
  static constexpr size_t kMinPayload = 8;
  static constexpr size_t kMaxPayload = kMinPayload + 6 * kMaxWheels + 4 * kMaxJoints + 2 * kMaxActuators;

  uint16_t sequence;
  /// For how long the wheels may follow this command: what is left of the time of the velocity that it comes
  /// from, so that repeating, queueing and forwarding do not prolong it. 0: stop.
  uint16_t valid_ms;
  uint8_t flags;                      ///< CommandFlags
  uint8_t wheels, joints, actuators;  ///< how many there are of what follows

  int16_t speed_mm_per_s[kMaxWheels];  ///< of the circumference
  int32_t steering_urad[kMaxWheels];
  int32_t joint_urad[kMaxJoints];
  int16_t actuator_permille[kMaxActuators];
};

/// Visits the fields of a message in the order in which they are sent, so that reading and writing cannot
/// differ.
template <class Stream, class Message>
struct Layout;

template <class Stream>
struct Layout<Stream, Telemetry> {
  template <class T>
  static void counts(Stream& stream, T& m) {
    stream.u16(m.sequence);
    stream.u32(m.time_us);
    stream.u16(m.command_sequence);
    stream.u8(m.mode);
    stream.u16(m.switches);
    stream.u16(m.battery_mV);
    stream.u16(m.bad_commands);
    stream.u16(m.lost_commands);
    stream.u8(m.wheels);
    stream.u8(m.joints);
    stream.u8(m.ranges);
    stream.u8(m.actuators);
  }
  template <class T>
  static void lists(Stream& stream, T& m) {
    for (uint8_t i = 0; i < m.wheels; ++i) {
      stream.i32(m.pulses[i]);
      stream.i32(m.steering_urad[i]);
      stream.i16(m.target_mm_per_s[i]);
    }
    for (uint8_t i = 0; i < m.joints; ++i) stream.i32(m.joint_urad[i]);
    for (uint8_t i = 0; i < m.ranges; ++i) stream.u16(m.range_mm[i]);
    for (uint8_t i = 0; i < m.actuators; ++i) stream.i16(m.actuator_permille[i]);
  }
};

template <class Stream>
struct Layout<Stream, Command> {
  template <class C>
  static void counts(Stream& stream, C& m) {
    stream.u16(m.sequence);
    stream.u16(m.valid_ms);
    stream.u8(m.flags);
    stream.u8(m.wheels);
    stream.u8(m.joints);
    stream.u8(m.actuators);
  }
  template <class C>
  static void lists(Stream& stream, C& m) {
    for (uint8_t i = 0; i < m.wheels; ++i) {
      stream.i16(m.speed_mm_per_s[i]);
      stream.i32(m.steering_urad[i]);
    }
    for (uint8_t i = 0; i < m.joints; ++i) stream.i32(m.joint_urad[i]);
    for (uint8_t i = 0; i < m.actuators; ++i) stream.i16(m.actuator_permille[i]);
  }
};

inline size_t payloadBytes(const Telemetry& m) {
  return Telemetry::kMinPayload + 10U * m.wheels + 4U * m.joints + 2U * m.ranges + 2U * m.actuators;
}
inline size_t payloadBytes(const Command& m) {
  return Command::kMinPayload + 6U * m.wheels + 4U * m.joints + 2U * m.actuators;
}

inline bool countsFit(const Telemetry& m) {
  return m.wheels <= kMaxWheels && m.joints <= kMaxJoints && m.ranges <= kMaxRanges &&
         m.actuators <= kMaxActuators && m.mode <= static_cast<uint8_t>(Mode::kStopped);
}
inline bool countsFit(const Command& m) {
  return m.wheels <= kMaxWheels && m.joints <= kMaxJoints && m.actuators <= kMaxActuators;
}

/// Stream that writes little-endian bytes.
class ByteWriter {
 public:
  explicit ByteWriter(uint8_t* at) : at_(at) {}
  void u8(uint8_t value) { *at_++ = value; }
  void u16(uint16_t value) {
    u8(static_cast<uint8_t>(value));
    u8(static_cast<uint8_t>(value >> 8));
  }
  void u32(uint32_t value) {
    u16(static_cast<uint16_t>(value));
    u16(static_cast<uint16_t>(value >> 16));
  }
  void i16(int16_t value) { u16(static_cast<uint16_t>(value)); }
  void i32(int32_t value) { u32(static_cast<uint32_t>(value)); }

 private:
  uint8_t* at_;
};

/// Stream that reads them.
class ByteReader {
 public:
  explicit ByteReader(const uint8_t* at) : at_(at) {}
  void u8(uint8_t& value) { value = *at_++; }
  void u16(uint16_t& value) {
    value = static_cast<uint16_t>(at_[0] | (at_[1] << 8));
    at_ += 2;
  }
  void u32(uint32_t& value) {
    uint16_t low = 0, high = 0;
    u16(low);
    u16(high);
    value = low | (static_cast<uint32_t>(high) << 16);
  }
  void i16(int16_t& value) {
    uint16_t bits = 0;
    u16(bits);
    value = static_cast<int16_t>(bits);
  }
  void i32(int32_t& value) {
    uint32_t bits = 0;
    u32(bits);
    value = static_cast<int32_t>(bits);
  }

 private:
  const uint8_t* at_;
};

/// Length of the longest frame with this message.
template <class Message>
constexpr size_t maxFrameBytes() {
  return kPrefixBytes + Message::kMaxPayload + kCrcBytes;
}

/// Writes a frame (at most maxFrameBytes<Message>()) and returns its length. `Crc::of(bytes, size)` is the
/// CRC-32.
template <class Crc, class Message>
size_t encode(const Message& message, uint8_t* frame) {
  const size_t payload = payloadBytes(message);
  frame[0] = kSync0;
  frame[1] = kSync1;
  frame[2] = Message::kType;
  frame[3] = static_cast<uint8_t>(payload);
  ByteWriter writer(frame + kPrefixBytes);
  Layout<ByteWriter, Message>::counts(writer, message);
  Layout<ByteWriter, Message>::lists(writer, message);
  ByteWriter(frame + kPrefixBytes + payload).u32(Crc::of(frame + 2, 2 + payload));
  return kPrefixBytes + payload + kCrcBytes;
}

}  // namespace base
}  // namespace stereo_nav
