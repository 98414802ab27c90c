#include "stereo_nav/sensors/imu/raw_protocol.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>
#include <vector>

#include "sensors/serial/crc32.h"
#include "sensors/serial/emulation/serial_line.h"
#include "unit/sensors/imu/allocation_counter.h"
#include "unit/sensors/imu/module_stream.h"

namespace stereo_nav::imu {
namespace {

RawMeasurement measurement(int k, bool magnetometer = false) {
  RawMeasurement m;
  m.sequence = static_cast<std::uint16_t>(k);
  m.device_time_us = static_cast<std::uint32_t>(1000 * k);
  m.angular_velocity << 0.125 * (k % 16), -0.5, 0.25;
  m.linear_acceleration << 0.5, -1.0, 9.75;
  if (magnetometer) m.magnetic_field = Eigen::Vector3d(20.0, -3.0, k % 7);
  return m;
}

Bytes encoded(const RawMeasurement& m) {
  Bytes frame(raw_protocol::kMaxFrameBytes);
  frame.resize(raw_protocol::encode(m, frame.data()));
  return frame;
}

std::vector<RawMeasurement> parse(RawParser& parser, const Bytes& bytes) {
  std::vector<RawMeasurement> found;
  for (const std::uint8_t byte : bytes) {
    if (const auto frame = parser.push(byte)) found.push_back(frame->measurement);
  }
  return found;
}

std::vector<RawMeasurement> parse(const Bytes& bytes) {
  RawParser parser;
  return parse(parser, bytes);
}

bool sameContent(const RawMeasurement& a, const RawMeasurement& b) {
  return a.sequence == b.sequence && a.device_time_us == b.device_time_us &&
         a.angular_velocity == b.angular_velocity && a.linear_acceleration == b.linear_acceleration;
}

TEST(Crc32, HasTheStandardCheckValue) {
  const std::string digits = "123456789";
  EXPECT_EQ(serial::crc32(reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size()), 0xCBF43926U);
}

TEST(RawProtocol, IsLaidOutAsDocumented) {
  RawMeasurement m = measurement(0x0102);
  m.device_time_us = 0x0A0B0C0D;
  const Bytes frame = encoded(m);
  ASSERT_EQ(frame.size(), 38U);
  const Bytes prefix = {0xA5, 0x5A, 1, 30, 0x02, 0x01, 0x0D, 0x0C, 0x0B, 0x0A};
  EXPECT_EQ(Bytes(frame.begin(), frame.begin() + 10), prefix);
  EXPECT_EQ(encoded(measurement(1, true)).size(), 50U);
}

TEST(RawProtocol, BringsMeasurementsAcross) {
  for (const bool magnetometer : {false, true}) {
    const auto found = parse(encoded(measurement(5, magnetometer)));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].sequence, 5);
    EXPECT_EQ(found[0].device_time_us, 5000U);
    EXPECT_EQ(found[0].angular_velocity, measurement(5).angular_velocity);
    EXPECT_EQ(found[0].linear_acceleration, measurement(5).linear_acceleration);
    ASSERT_EQ(found[0].magnetic_field.has_value(), magnetometer);
    if (magnetometer) {
      EXPECT_EQ(found[0].magnetic_field.value(), Eigen::Vector3d(20.0, -3.0, 5.0));
    }
  }
}

TEST(RawProtocol, NoSingleCorruptByteGetsThrough) {
  const Bytes good = encoded(measurement(3));
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (int difference = 1; difference < 256; ++difference) {
      Bytes bad = good;
      bad[i] = static_cast<std::uint8_t>(bad[i] ^ difference);
      append(bad, Bytes(raw_protocol::kMaxFrameBytes, 0));
      ASSERT_TRUE(parse(bad).empty()) << "byte " << i;
    }
  }
}

TEST(RawProtocol, AFalseBeginningHidesNoFrame) {
  Bytes bytes = {0xA5, 0x5A, 2, 42, 1, 2, 3};  // claims 50 bytes, into the next frames
  for (int k = 0; k < 3; ++k) append(bytes, encoded(measurement(k)));
  RawParser parser;
  EXPECT_EQ(parse(parser, bytes).size(), 3U);
  EXPECT_EQ(parser.counters().bad_crc, 1U);
  EXPECT_EQ(parser.counters().bytes_skipped, 7U);
}

TEST(RawProtocol, CountsLostFramesAcrossTheWrapOfTheSequence) {
  RawParser parser;
  for (const int k : {65533, 65534, 2, 3}) parse(parser, encoded(measurement(k)));
  EXPECT_EQ(parser.counters().lost, 3U);
}

TEST(RawProtocol, AModuleThatBeginsAgainHasLostNothing) {
  RawParser parser;
  for (const int k : {40000, 0, 1}) parse(parser, encoded(measurement(k)));
  EXPECT_EQ(parser.counters().lost, 0U);
}

TEST(RawProtocol, RefusesWhatNoSensorMeasures) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 1e9}) {
    RawMeasurement m = measurement(1);
    m.linear_acceleration.y() = bad;
    RawParser parser;
    EXPECT_TRUE(parse(parser, encoded(m)).empty());
    EXPECT_EQ(parser.counters().impossible, 1U);
  }
}

TEST(RawProtocol, AllocatesNothing) {
  Bytes bytes;
  for (int k = 0; k < 100; ++k) append(bytes, encoded(measurement(k)));
  RawParser parser;
  const std::size_t before = allocationCount();
  for (const std::uint8_t byte : bytes) parser.push(byte);
  EXPECT_EQ(allocationCount(), before);
}

/// A million frames, one byte in a hundred damaged: intact frames come through, nothing else does.
TEST(RawProtocol, DeliversIntactFramesOfADamagedStreamAndNoOther) {
  constexpr int kFrames = 1000000;
  serial::LineFaults faults(0.005, 0.005, 21);
  RawParser parser;
  std::vector<bool> intact, delivered(kFrames, false);
  Bytes line;
  std::size_t false_frames = 0;
  for (int k = 0; k < kFrames; ++k) {
    const Bytes frame = encoded(measurement(k));
    line.clear();
    intact.push_back(faults.pass(frame.data(), frame.size(), line));
    for (const std::uint8_t byte : line) {
      const auto found = parser.push(byte);
      if (!found) continue;
      const std::size_t number = found->measurement.device_time_us / 1000;
      // A lost last byte may happen to equal the next frame's first one: damaged, yet right.
      const bool right =
          number < intact.size() && sameContent(found->measurement, measurement(static_cast<int>(number)));
      if (right) {
        delivered[number] = true;
      } else {
        ++false_frames;
      }
    }
  }
  std::size_t intact_count = 0, delivered_count = 0;
  for (std::size_t k = 0; k < intact.size(); ++k) {
    intact_count += intact[k];
    delivered_count += intact[k] && delivered[k];
  }
  const double share = static_cast<double>(delivered_count) / static_cast<double>(intact_count);
  std::printf("raw, 1 %% of bytes damaged: intact frames delivered %.3f %%, others %zu\n", 100 * share,
              false_frames);
  EXPECT_GE(share, 0.90);
  EXPECT_EQ(false_frames, 0U);
}

}  // namespace
}  // namespace stereo_nav::imu
