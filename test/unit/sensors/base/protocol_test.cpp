#include "sensors/base/controller/protocol.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "sensors/base/controller/small_crc32.h"
#include "sensors/serial/emulation/serial_line.h"
#include "unit/sensors/base/base_messages.h"

namespace stereo_nav::base {
namespace {

template <class Message>
struct Made;
template <>
struct Made<Telemetry> {
  static Telemetry message(std::uint32_t k) { return telemetryOf(k); }
};
template <>
struct Made<Command> {
  static Command message(std::uint32_t k) { return commandOf(k); }
};

/// What holds of both directions.
template <class Message>
class BaseProtocol : public testing::Test {
 protected:
  static Bytes frame(std::uint32_t k) { return encoded(Made<Message>::message(k)); }

  FrameParser<Message, Crc32> parser_;
};

using Directions = testing::Types<Telemetry, Command>;
TYPED_TEST_SUITE(BaseProtocol, Directions);

TEST(BaseCrc, BothImplementationsHaveTheStandardCheckValue) {
  const std::string digits = "123456789";
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(digits.data());
  EXPECT_EQ(Crc32::of(bytes, digits.size()), 0xCBF43926U);
  EXPECT_EQ(SmallCrc32::of(bytes, digits.size()), 0xCBF43926U);
}

TEST(BaseCrc, BothImplementationsAgree) {
  std::mt19937 random(3);
  for (std::size_t size = 0; size < 200; ++size) {
    Bytes bytes(size);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    EXPECT_EQ(Crc32::of(bytes.data(), size), SmallCrc32::of(bytes.data(), size));
  }
}

TEST(BaseFrames, TelemetryIsLaidOutAsDocumented) {
  Telemetry t{};
  t.sequence = 0x0102;
  t.time_us = 0x03040506;
  t.command_sequence = 0x0708;
  t.mode = 2;
  t.switches = 0x090A;
  t.battery_mV = 0x0B0C;
  t.bad_commands = 0x0D0E;
  t.lost_commands = 0x0F10;
  t.wheels = t.joints = t.ranges = t.actuators = 1;
  t.pulses[0] = -2;
  t.steering_urad[0] = 0x11121314;
  t.target_mm_per_s[0] = -3;
  t.joint_urad[0] = 0x15161718;
  t.range_mm[0] = 0x191A;
  t.actuator_permille[0] = 0x1B1C;
  const Bytes content = {0xB5, 0x62, 1,    39,   0x02, 0x01, 0x06, 0x05, 0x04, 0x03, 0x08,
                         0x07, 2,    0x0A, 0x09, 0x0C, 0x0B, 0x0E, 0x0D, 0x10, 0x0F, 1,
                         1,    1,    1,    0xFE, 0xFF, 0xFF, 0xFF, 0x14, 0x13, 0x12, 0x11,
                         0xFD, 0xFF, 0x18, 0x17, 0x16, 0x15, 0x1A, 0x19, 0x1C, 0x1B};
  const Bytes frame = encoded(t);
  ASSERT_EQ(frame.size(), content.size() + kCrcBytes);
  EXPECT_EQ(Bytes(frame.begin(), frame.end() - kCrcBytes), content);
}

TEST(BaseFrames, CommandsAreLaidOutAsDocumented) {
  Command c{};
  c.sequence = 0x0102;
  c.valid_ms = 0x012C;
  c.flags = kRelease;
  c.wheels = c.joints = c.actuators = 1;
  c.speed_mm_per_s[0] = -2;
  c.steering_urad[0] = 0x11121314;
  c.joint_urad[0] = 0x15161718;
  c.actuator_permille[0] = 0x191A;
  const Bytes content = {0xB5, 0x62, 2,    20,   0x02, 0x01, 0x2C, 0x01, 2,    1,    1,    1,
                         0xFE, 0xFF, 0x14, 0x13, 0x12, 0x11, 0x18, 0x17, 0x16, 0x15, 0x1A, 0x19};
  const Bytes frame = encoded(c);
  ASSERT_EQ(frame.size(), content.size() + kCrcBytes);
  EXPECT_EQ(Bytes(frame.begin(), frame.end() - kCrcBytes), content);
}

TYPED_TEST(BaseProtocol, BringsMessagesAcross) {
  const auto found = parse(this->parser_, this->frame(5));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(encoded(found[0]), this->frame(5));
  EXPECT_EQ(found[0].sequence, 5);
  EXPECT_EQ(found[0].steering_urad[3], Made<TypeParam>::message(5).steering_urad[3]);
}

TYPED_TEST(BaseProtocol, NoSingleCorruptByteGetsThrough) {
  const Bytes good = this->frame(3);
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (int difference = 1; difference < 256; ++difference) {
      Bytes bad = good;
      bad[i] = static_cast<std::uint8_t>(bad[i] ^ difference);
      append(bad, Bytes(maxFrameBytes<TypeParam>(), 0));
      FrameParser<TypeParam, Crc32> parser;
      ASSERT_TRUE(parse(parser, bad).empty()) << "byte " << i;
    }
  }
}

TYPED_TEST(BaseProtocol, NoShortenedFrameGetsThroughNorHidesTheNextOne) {
  const Bytes good = this->frame(3);
  for (std::size_t length = 0; length < good.size(); ++length) {
    Bytes stream(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
    append(stream, this->frame(4));
    append(stream, Bytes(maxFrameBytes<TypeParam>(), 0));
    FrameParser<TypeParam, Crc32> parser;
    const auto found = parse(parser, stream);
    ASSERT_EQ(found.size(), 1U) << length;
    ASSERT_EQ(found[0].sequence, 4) << length;
  }
}

TYPED_TEST(BaseProtocol, AFalseBeginningHidesNoFrame) {
  Bytes bytes = {kSync0, kSync1, TypeParam::kType, static_cast<std::uint8_t>(TypeParam::kMaxPayload), 1,
                 2,      3};
  for (std::uint32_t k = 0; k < 5; ++k) append(bytes, this->frame(k));
  append(bytes, Bytes(maxFrameBytes<TypeParam>(), 0));
  EXPECT_EQ(parse(this->parser_, bytes).size(), 5U);
  EXPECT_EQ(this->parser_.counters().bad_crc, 1U);
}

TYPED_TEST(BaseProtocol, TheOtherDirectionIsNotHeard) {
  const Bytes other = TypeParam::kType == Telemetry::kType ? encoded(commandOf(1)) : encoded(telemetryOf(1));
  EXPECT_TRUE(parse(this->parser_, other).empty());
}

TYPED_TEST(BaseProtocol, CountsLostFramesAcrossTheWrapOfTheSequence) {
  for (const std::uint32_t k : {65533U, 65534U, 2U, 3U}) parse(this->parser_, this->frame(k));
  EXPECT_EQ(this->parser_.counters().lost, 3U);
  EXPECT_EQ(this->parser_.counters().delivered, 4U);
}

TYPED_TEST(BaseProtocol, RepeatedAndLateFramesAreDropped) {
  std::vector<int> delivered;
  for (const std::uint32_t k : {10U, 12U, 11U, 12U, 13U, 65535U, 14U}) {
    for (const auto& message : parse(this->parser_, this->frame(k))) delivered.push_back(message.sequence);
  }
  EXPECT_EQ(delivered, (std::vector<int>{10, 12, 13, 14}));
  EXPECT_EQ(this->parser_.counters().stale, 3U);
}

TYPED_TEST(BaseProtocol, ASenderThatBeginsAgainIsHeardAndHasLostNothing) {
  for (const std::uint32_t k : {40000U, 0U, 1U}) parse(this->parser_, this->frame(k));
  EXPECT_EQ(this->parser_.counters().delivered, 3U);
  EXPECT_EQ(this->parser_.counters().lost, 0U);
  this->parser_.forgetSequence();
  parse(this->parser_, this->frame(0));
  EXPECT_EQ(this->parser_.counters().delivered, 4U) << "after a silence even a number as near as this is new";
}

TYPED_TEST(BaseProtocol, CountsThatContradictTheLengthAreRefused) {
  TypeParam message = Made<TypeParam>::message(1);
  Bytes frame = encoded(message);
  // The number of wheels: 3 instead of 4, with a right check sum.
  const std::size_t wheels = kPrefixBytes + (TypeParam::kType == Telemetry::kType ? 17 : 5);
  ASSERT_EQ(frame[wheels], 4);
  for (const int wrong : {3, 5, 200}) {
    frame[wheels] = static_cast<std::uint8_t>(wrong);
    ByteWriter(&frame[frame.size() - kCrcBytes]).u32(Crc32::of(&frame[2], frame.size() - 2 - kCrcBytes));
    EXPECT_TRUE(parse(this->parser_, frame).empty());
  }
  EXPECT_EQ(this->parser_.counters().impossible, 3U);
}

TYPED_TEST(BaseProtocol, GarbageIsSkipped) {
  std::mt19937 random(5);
  Bytes stream;
  for (std::uint32_t k = 0; k < 200; ++k) {
    for (auto i = random() % 100; i > 0; --i) stream.push_back(static_cast<std::uint8_t>(random()));
    append(stream, this->frame(k));
  }
  append(stream, Bytes(maxFrameBytes<TypeParam>(), 0));
  EXPECT_EQ(parse(this->parser_, stream).size(), 200U);
}

/// A million frames, one byte in a hundred damaged or lost: intact frames come through, nothing else does.
template <class Message>
class DamagedBaseStream : public testing::Test {};
TYPED_TEST_SUITE(DamagedBaseStream, Directions);

TYPED_TEST(DamagedBaseStream, DeliversIntactFramesAndNoOther) {
  constexpr std::uint32_t kFrames = 1000000;
  serial::LineFaults faults(0.005, 0.005, 21);
  FrameParser<TypeParam, Crc32> parser;
  TypeParam message{};
  Bytes frame(maxFrameBytes<TypeParam>()), line;
  std::size_t intact = 0, delivered_intact = 0, false_frames = 0;
  std::vector<bool> is_intact(65536, false);
  for (std::uint32_t k = 0; k < kFrames; ++k) {
    const std::size_t size = encode<Crc32>(Made<TypeParam>::message(k), frame.data());
    line.clear();
    const bool whole = faults.pass(frame.data(), size, line);
    is_intact[k % 65536] = whole;
    intact += whole;
    for (const std::uint8_t byte : line) {
      if (!parser.push(byte, message)) continue;
      // A frame comes with its last byte, or within the next few.
      const std::uint32_t number = k - static_cast<std::uint16_t>(k - message.sequence);
      // A lost last byte may happen to equal the next frame's first one: damaged, yet right.
      const bool right = encoded(message) == encoded(Made<TypeParam>::message(number));
      false_frames += !right;
      delivered_intact += right && is_intact[number % 65536];
    }
  }
  const double share = static_cast<double>(delivered_intact) / static_cast<double>(intact);
  std::printf("%s, 1 %% of bytes damaged: intact frames delivered %.3f %%, others %zu\n",
              TypeParam::kType == Telemetry::kType ? "telemetry" : "commands", 100 * share, false_frames);
  EXPECT_GE(share, 0.9999);
  EXPECT_EQ(false_frames, 0U);
}

}  // namespace
}  // namespace stereo_nav::base
