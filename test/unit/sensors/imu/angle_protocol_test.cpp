#include "sensors/imu/angle_protocol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/angles.h"
#include "sensors/imu/angle_gate.h"
#include "sensors/imu/emulation/emulated_module.h"
#include "sensors/imu/frame_decoder.h"
#include "unit/sensors/imu/allocation_counter.h"
#include "unit/sensors/imu/module_stream.h"

namespace stereo_nav::imu {
namespace {

Bytes encoded(const ModuleAngles& angles, AngleOrder order = AngleOrder::kYawPitchRoll) {
  Bytes frame(AngleFramer::kFrameBytes);
  encodeAngleFrame(angles, order, frame.data());
  return frame;
}

/// Frames of a steady turn: frame k has yaw 0.2 k, pitch 1, roll -2.
ModuleAngles steadyTurn(int k) {
  return {wrapDegrees(0.2 * k), 1.0, -2.0};
}

struct Delivered {
  std::vector<ModuleAngles> angles;
  std::vector<double> clock;
  DecoderCounters counters;
};

/// All bytes at the pace of the line.
Delivered decode(const Bytes& bytes, std::size_t chunk = 15) {
  const auto decoder = makeAngleDecoder(AngleOrder::kYawPitchRoll, AngleGateParams(), kBaud);
  Delivered delivered;
  for (std::size_t i = 0; i < bytes.size(); i += chunk) {
    const std::size_t size = std::min(chunk, bytes.size() - i);
    decoder->push(&bytes[i], size, kPeriod_s * static_cast<double>(i + size) / 15.0,
                  [&](const DecodedFrame& frame) {
                    delivered.angles.push_back(*frame.angles);
                    delivered.clock.push_back(frame.device_clock);
                  });
  }
  delivered.counters = decoder->counters();
  return delivered;
}

TEST(AngleProtocol, DeliversEveryFrameOfACleanStreamHoweverItIsCut) {
  Bytes bytes;
  for (int k = 0; k < 2000; ++k) append(bytes, encoded(steadyTurn(k)));
  for (const std::size_t chunk : {1U, 7U, 15U, 64U, 4096U}) {
    const Delivered delivered = decode(bytes, chunk);
    ASSERT_EQ(delivered.angles.size(), 2000U) << "chunks of " << chunk;
    for (int k = 0; k < 2000; ++k) {
      ASSERT_NEAR(delivered.angles[static_cast<std::size_t>(k)].yaw_deg, steadyTurn(k).yaw_deg, 1e-4);
      ASSERT_EQ(delivered.clock[static_cast<std::size_t>(k)], k);
    }
    EXPECT_EQ(delivered.counters.bytes_skipped, 0U);
    EXPECT_EQ(delivered.counters.bad_frames, 0U);
  }
}

TEST(AngleProtocol, KnowsBothOrders) {
  AngleFramer framer(AngleOrder::kRollPitchYaw);
  std::optional<AngleCandidate> candidate;
  for (const std::uint8_t byte : encoded({30.0, 10.0, -5.0}, AngleOrder::kRollPitchYaw)) {
    candidate = framer.push(byte);
  }
  ASSERT_TRUE(candidate);
  EXPECT_EQ(candidate->angles.yaw_deg, 30.0);
  EXPECT_EQ(candidate->angles.roll_deg, -5.0);
}

TEST(AngleProtocol, FindsFramesBehindGarbage) {
  std::mt19937 random(3);
  Bytes bytes;
  for (int i = 0; i < 1000; ++i) bytes.push_back(static_cast<std::uint8_t>(random()));
  for (int k = 0; k < 100; ++k) append(bytes, encoded(steadyTurn(k)));
  EXPECT_EQ(decode(bytes).angles.size(), 100U);
}

TEST(AngleProtocol, IsNotMisledByHeadersInsideFloats) {
  // Started at every byte of the stream, in particular on the false headers.
  EmulatedModule module(Protocol::kAngles, AngleOrder::kYawPitchRoll, false, {}, 1);
  Bytes bytes;
  for (int k = 0; k < 100; ++k) append(bytes, module.frame(headerInsideFloats()(0.01 * k), 0.01 * k));
  ASSERT_EQ(std::string(bytes.begin() + 3, bytes.begin() + 6), "its");
  ASSERT_EQ(std::string(bytes.begin() + 7, bytes.begin() + 10), "its");
  ASSERT_EQ(std::string(bytes.begin() + 11, bytes.begin() + 14), "its");
  for (std::ptrdiff_t start = 0; start < 15; ++start) {
    const Delivered delivered = decode(Bytes(bytes.begin() + start, bytes.end()));
    EXPECT_EQ(delivered.angles.size(), start == 0 ? 100U : 99U) << "started at byte " << start;
    for (const ModuleAngles& angles : delivered.angles) {
      ASSERT_NEAR(angles.yaw_deg, 60.8636818, 1e-5);
      ASSERT_NEAR(angles.pitch_deg, 15.2159204, 1e-5);
      ASSERT_NEAR(angles.roll_deg, 3.8039801, 1e-5);
    }
  }
}

TEST(AngleProtocol, RefusesWhatNoModuleSends) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const ModuleAngles& bad :
       {ModuleAngles{std::nan(""), 0, 0}, ModuleAngles{0, infinity, 0}, ModuleAngles{0, 0, -infinity},
        ModuleAngles{361, 0, 0}, ModuleAngles{0, 181, 0}, ModuleAngles{0, 0, 1e30}}) {
    Bytes bytes;
    for (int k = 0; k < 20; ++k) append(bytes, encoded(bad));
    EXPECT_TRUE(decode(bytes).angles.empty());
    EXPECT_GT(decode(bytes).counters.bad_frames, 0U);
  }
}

TEST(AngleProtocol, RefusesAFrameWithoutNeighbours) {
  Bytes bytes;
  const Bytes filler(40, 0x20);
  for (int k = 0; k < 50; ++k) {
    append(bytes, encoded({1.0, 2.0, 3.0}));
    append(bytes, filler);
  }
  EXPECT_TRUE(decode(bytes).angles.empty());
}

TEST(AngleProtocol, RefusesAJumpOfOneFrameAndDeliversItsNeighbours) {
  Bytes bytes;
  for (int k = 0; k < 100; ++k) {
    ModuleAngles angles = steadyTurn(k);
    if (k == 50) angles.pitch_deg += 1.0;
    append(bytes, encoded(angles));
  }
  const Delivered delivered = decode(bytes);
  EXPECT_EQ(delivered.angles.size(), 99U);
  for (const ModuleAngles& angles : delivered.angles) EXPECT_EQ(angles.pitch_deg, 1.0);
  EXPECT_EQ(delivered.counters.bad_frames, 1U);
  EXPECT_EQ(delivered.counters.lost_frames, 1U);
}

TEST(AngleProtocol, FollowsAModuleThatSetsItsYawToZero) {
  Bytes bytes;
  for (int k = 0; k < 50; ++k) append(bytes, encoded({100.0, 0.0, 0.0}));
  for (int k = 0; k < 50; ++k) append(bytes, encoded({0.0, 0.0, 0.0}));
  EXPECT_EQ(decode(bytes).angles.size(), 100U);
}

TEST(AngleProtocol, YawPassesTheWrap) {
  Bytes bytes;
  for (int k = 0; k < 4000; ++k) append(bytes, encoded({wrapDegrees(1.5 * k), 0.0, 0.0}));
  EXPECT_EQ(decode(bytes).angles.size(), 4000U);
  bytes.clear();
  for (int k = 0; k < 4000; ++k) append(bytes, encoded({std::fmod(1.5 * k, 360.0), 0.0, 0.0}));
  EXPECT_EQ(decode(bytes).angles.size(), 4000U);
}

TEST(AngleProtocol, DeliversASlowModuleThatAccelerates) {
  // 20 Hz, 1000 deg/s^2 back and forth; the first frames serve to learn the module's rate.
  const auto decoder = makeAngleDecoder(AngleOrder::kYawPitchRoll, AngleGateParams(), kBaud);
  std::size_t count = 0;
  for (int k = 0; k < 1000; ++k) {
    const double t = 0.05 * k;
    const Bytes frame = encoded({62.5 * std::sin(4.0 * t), 0.0, 0.0});
    decoder->push(frame.data(), frame.size(), t, [&](const DecodedFrame&) { ++count; });
  }
  EXPECT_GE(count, 995U);
}

TEST(AngleProtocol, TellsAPausingModuleFromALateReader) {
  const auto decoder = makeAngleDecoder(AngleOrder::kYawPitchRoll, AngleGateParams(), kBaud);
  int restarts = 0, frames = 0, k = 0;
  const auto count = [&](const DecodedFrame& frame) {
    restarts += frame.clock_restarted;
    ++frames;
  };
  const auto read = [&](int frame_count, double time_s) {
    Bytes bytes;
    for (int i = 0; i < frame_count; ++i) append(bytes, encoded(steadyTurn(k++)));
    decoder->push(bytes.data(), bytes.size(), time_s, count);
  };
  for (int i = 0; i < 200; ++i) read(1, 0.01 * i);
  read(150, 3.5);  // the reader slept for 1.5 s
  for (int i = 0; i < 200; ++i) read(1, 3.51 + 0.01 * i);
  EXPECT_EQ(restarts, 0);
  for (int i = 0; i < 200; ++i) read(1, 7.0 + 0.01 * i);  // the module did
  EXPECT_EQ(restarts, 1);
  EXPECT_EQ(frames, k);
}

TEST(AngleProtocol, AllocatesNothingOnceRunning) {
  Bytes bytes;
  std::mt19937 random(5);
  for (int k = 0; k < 1000; ++k) {
    append(bytes, encoded(steadyTurn(k)));
    bytes[bytes.size() - 1 - random() % 100 % bytes.size()] ^= static_cast<std::uint8_t>(random());
  }
  const auto decoder = makeAngleDecoder(AngleOrder::kYawPitchRoll, AngleGateParams(), kBaud);
  std::size_t frames = 0;
  const FrameDecoder::Sink sink = [&](const DecodedFrame&) { ++frames; };
  const std::size_t before = allocationCount();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    decoder->push(&bytes[i], 1, 1e-4 * static_cast<double>(i), sink);
  }
  EXPECT_EQ(allocationCount(), before);
  EXPECT_GT(frames, 100U);
}

}  // namespace
}  // namespace stereo_nav::imu
