#include "sensors/range/tfmini_protocol.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "unit/sensors/range/range_stream.h"

namespace stereo_nav::range {
namespace {

constexpr std::uint64_t kBefore = 10, kFrames = 30;

TEST(TfminiParser, FramesAreAsDocumented) {
  // 1.21 m, strength 0x0304, 25.5 degrees.
  const Bytes frame = {0x59, 0x59, 0x79, 0x00, 0x04, 0x03, 0xCC, 0x08, 0x06};
  TfminiParser parser;
  EXPECT_TRUE(parsed(parser, frame).empty()) << "a first frame waits for the header behind it";
  const auto frames = parsed(parser, frame);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].measurement.distance_cm, 121);
  EXPECT_EQ(frames[0].measurement.strength, 0x0304);
  EXPECT_EQ(frames[0].measurement.temperature, (256 * 8) + 204);
  EXPECT_EQ(frames[0].last_byte, 8U);
  EXPECT_EQ(frames[1].last_byte, 17U);
  Bytes again(tfmini::kFrameBytes);
  tfmini::encode(frames[0].measurement, again.data());
  EXPECT_EQ(again, frame);
}

TEST(TfminiParser, DeliversEveryFrameOfACleanStream) {
  TfminiParser parser;
  const auto frames = parsed(parser, bytesOf(0, 5000));
  ASSERT_EQ(frames.size(), 5000U);
  for (std::uint64_t k = 0; k < 5000; ++k) {
    ASSERT_TRUE(same(frames[k].measurement, measurementOf(k))) << k;
    EXPECT_EQ(frames[k].index, k + 1);
  }
  EXPECT_EQ(parser.counters().bytes_skipped, 0U);
}

/// All frames but those from kBefore to before `next` arrive, with their right numbers, and nothing else.
void expectRecovery(const Bytes& between, std::uint64_t next, const std::string& what) {
  TfminiParser parser;
  Bytes bytes = bytesOf(0, kBefore);
  bytes.insert(bytes.end(), between.begin(), between.end());
  const Bytes behind = bytesOf(next, kFrames);
  bytes.insert(bytes.end(), behind.begin(), behind.end());
  const auto frames = parsed(parser, bytes);
  ASSERT_EQ(frames.size(), kBefore + kFrames - next) << what;
  for (std::uint64_t i = 0; i < frames.size(); ++i) {
    const std::uint64_t k = i < kBefore ? i : i - kBefore + next;
    EXPECT_TRUE(same(frames[i].measurement, measurementOf(k))) << what << ": frame " << k;
    EXPECT_EQ(frames[i].index, k + 1) << what;
  }
}

TEST(TfminiParser, DamageToAnyByteCostsItsOwnFrameOnly) {
  for (std::size_t byte = 0; byte < tfmini::kFrameBytes; ++byte) {
    for (unsigned difference = 1; difference < 256; ++difference) {
      Bytes damaged = bytesOf(kBefore);
      damaged[byte] = static_cast<std::uint8_t>(damaged[byte] ^ difference);
      expectRecovery(damaged, kBefore + 1,
                     "byte " + std::to_string(byte) + " changed by " + std::to_string(difference));
    }
  }
}

TEST(TfminiParser, LostBytesCostTheirFrameOnly) {
  for (std::size_t first = 0; first < tfmini::kFrameBytes; ++first) {
    for (std::size_t count = 1; first + count <= tfmini::kFrameBytes && count < tfmini::kFrameBytes;
         ++count) {
      Bytes shortened = bytesOf(kBefore);
      shortened.erase(shortened.begin() + static_cast<std::ptrdiff_t>(first),
                      shortened.begin() + static_cast<std::ptrdiff_t>(first + count));
      expectRecovery(shortened, kBefore + 1, std::to_string(count) + " lost from " + std::to_string(first));
    }
  }
}

TEST(TfminiParser, GarbageIsLeftOut) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 2000; ++trial) {
    TfminiParser parser;
    Bytes bytes = bytesOf(0, kBefore);
    for (auto count = random() % 40; count > 0; --count) bytes.push_back(static_cast<std::uint8_t>(random()));
    const Bytes behind = bytesOf(kBefore, kFrames);
    bytes.insert(bytes.end(), behind.begin(), behind.end());
    EXPECT_EQ(parsed(parser, bytes).size(), kFrames) << "trial " << trial;
  }
}

TEST(TfminiParser, RandomBytesAreNoFrames) {
  TfminiParser parser;
  std::mt19937 random(3);
  Bytes garbage(10000000);
  for (std::uint8_t& byte : garbage) byte = static_cast<std::uint8_t>(random());
  EXPECT_LE(parsed(parser, garbage).size(), 1U);
}

}  // namespace
}  // namespace stereo_nav::range
