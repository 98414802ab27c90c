#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "sensors/imu/emulation/emulated_module.h"
#include "sensors/imu/emulation/motion.h"
#include "sensors/imu/frame_decoder.h"

namespace stereo_nav::imu {
namespace {

using Datagram = std::vector<std::uint8_t>;

/// The decoder of a protocol over UDP, and the module that feeds it; each datagram turns by its own number.
class DatagramDecoderTest : public testing::TestWithParam<Protocol> {
 protected:
  Datagram datagram(int k) {
    MotionState state;
    state.linear_acceleration.z() = 9.8;
    state.angular_velocity.z() = 1e-3 * (k % 1000);
    return module_.frame(state, 0.01 * k);
  }

  void push(const Datagram& bytes, double time_s = 0.0) {
    decoder_->push(bytes.data(), bytes.size(), time_s,
                   [this](const DecodedFrame& frame) { frames_.push_back(frame); });
  }

  EmulatedModule module_{GetParam(), AngleOrder::kYawPitchRoll, false, ModuleErrors(), 1};
  std::unique_ptr<FrameDecoder> decoder_ =
      GetParam() == Protocol::kRaw ? makeRawDatagramDecoder() : makePhoneDecoder();
  std::vector<DecodedFrame> frames_;
};

TEST_P(DatagramDecoderTest, EachDatagramIsAMeasurement) {
  for (int k = 0; k < 500; ++k) push(datagram(k), 100.0 + 0.01 * k);
  ASSERT_EQ(frames_.size(), 500U);
  for (int k = 0; k < 500; ++k) {
    EXPECT_NEAR(frames_[static_cast<std::size_t>(k)].raw->angular_velocity.z(), 1e-3 * k, 1e-4);
    EXPECT_NEAR(frames_[static_cast<std::size_t>(k)].device_clock - frames_[0].device_clock, 0.01 * k, 2e-5);
    EXPECT_DOUBLE_EQ(frames_[static_cast<std::size_t>(k)].arrival_s, 100.0 + 0.01 * k);
  }
  EXPECT_EQ(
      decoder_->counters().lost_frames + decoder_->counters().late_frames + decoder_->counters().bad_frames,
      0U);
}

TEST_P(DatagramDecoderTest, LostOvertakenAndDoubledOnesAreCounted) {
  std::vector<Datagram> sent;
  for (int k = 0; k < 100; ++k) sent.push_back(datagram(k));
  std::swap(sent[20], sent[21]);
  std::swap(sent[60], sent[63]);
  sent.insert(sent.begin() + 80, sent[79]);
  sent.erase(sent.begin() + 40, sent.begin() + 43);
  for (const Datagram& bytes : sent) push(bytes);
  for (std::size_t i = 1; i < frames_.size(); ++i)
    EXPECT_GT(frames_[i].device_clock, frames_[i - 1].device_clock);
  // Late are 20; 61, 62 and 60, which 63 has overtaken; and the second 79. 40 to 42 have not arrived at all.
  EXPECT_EQ(decoder_->counters().late_frames, 5U);
  EXPECT_EQ(decoder_->counters().lost_frames, 3U + 1U + 3U) << "overtaken ones are among the lost";
  EXPECT_EQ(frames_.size(), 100U - 7U);
}

TEST_P(DatagramDecoderTest, ADeviceThatWasStartedAgainBeginsANewStream) {
  for (int k = 1000; k < 1010; ++k) push(datagram(k));
  for (int k = 0; k < 10; ++k) push(datagram(k));
  EXPECT_EQ(frames_.size(), 20U);
  EXPECT_EQ(decoder_->counters().late_frames, 0U);
}

TEST_P(DatagramDecoderTest, GarbageIsCountedAndHarmsNothing) {
  std::mt19937 random(6);
  for (int k = 0; k < 2000; ++k) {
    Datagram garbage(random() % 200);
    for (std::uint8_t& byte : garbage) byte = static_cast<std::uint8_t>(random());
    push(garbage);
    push(datagram(k));
  }
  EXPECT_EQ(frames_.size(), 2000U);
  EXPECT_EQ(decoder_->counters().lost_frames, 0U);
  EXPECT_GT(decoder_->counters().bad_frames, 1900U);
}

TEST_P(DatagramDecoderTest, OfAMillionThroughABadNetworkTheIntactOnesArriveInOrder) {
  constexpr int kMillion = 1000000;
  std::mt19937 random(7);
  std::uint64_t intact = 0, delivered = 0, backwards = 0;
  double last = -1.0;
  Datagram kept;
  const auto receive = [&](const Datagram& bytes) {
    decoder_->push(bytes.data(), bytes.size(), 0.0, [&](const DecodedFrame& frame) {
      ++delivered;
      if (frame.device_clock <= last) ++backwards;
      last = frame.device_clock;
    });
  };
  for (int k = 0; k < kMillion; ++k) {
    Datagram bytes = datagram(k);
    const auto fate = random() % 1000;
    if (fate < 10) continue;  // lost
    if (fate < 20) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    if (fate < 30 && kept.empty() && fate >= 20) {
      kept = bytes;
      continue;
    }
    intact += static_cast<std::uint64_t>(fate >= 30);
    receive(bytes);
    if (!kept.empty()) receive(kept);
    kept.clear();
  }
  // A digit of the time that became another one may overtake the next second, or be taken for a new start.
  EXPECT_GT(static_cast<double>(delivered), 0.95 * static_cast<double>(intact));
  EXPECT_LT(backwards, 1500U);
  if (GetParam() == Protocol::kRaw) {
    EXPECT_GE(delivered, intact);
    EXPECT_EQ(backwards, 0U);
  }
  std::cout << "delivered " << delivered << " of " << intact << " intact ones, late "
            << decoder_->counters().late_frames << ", lost " << decoder_->counters().lost_frames << ", bad "
            << decoder_->counters().bad_frames << "\n";
}

INSTANTIATE_TEST_SUITE_P(Protocols, DatagramDecoderTest, testing::Values(Protocol::kRaw, Protocol::kPhone));

}  // namespace
}  // namespace stereo_nav::imu
