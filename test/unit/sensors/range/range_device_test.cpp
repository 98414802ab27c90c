#include "sensors/range/range_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "sensors/serial/emulation/pseudo_terminal.h"
#include "sensors/serial/steady_clock.h"
#include "unit/sensors/range/range_stream.h"

namespace stereo_nav::range {
namespace {

using serial::LinkState;
using serial::steadyNow_s;

TEST(RangeOf, FollowsRep117) {
  const RangeDeviceParams params;
  const auto range = [&](std::uint16_t distance_cm, std::uint16_t strength) {
    return rangeOf({distance_cm, strength, 0}, params);
  };
  EXPECT_DOUBLE_EQ(range(121, 500), 1.21);
  EXPECT_EQ(range(5, 500), -INFINITY) << "nearer than the minimum";
  EXPECT_EQ(range(1201, 500), INFINITY) << "beyond the maximum";
  EXPECT_EQ(range(0, 99), INFINITY) << "too little light: nothing within reach";
  EXPECT_EQ(range(65535, 20), INFINITY) << "the same, as the TFmini-S says it";
  EXPECT_TRUE(std::isnan(range(0, 65535))) << "dazzled";
  EXPECT_TRUE(std::isnan(range(65532, 500))) << "the TFmini-S in sunlight";
}

class RangeDeviceTest : public testing::Test {
 protected:
  void begin(const std::string& path) {
    RangeDeviceParams params;
    params.link = {0.05, 0.1};
    device_ = std::make_unique<RangeDevice>(params, serial::PortFinder(path, "/nonexistent"));
    device_->poll(0.0, [](const RangeReading&) {});
  }

  /// Polls until the condition holds. The limit is generous, since polling ends as soon as it holds.
  bool pollUntil(
      const std::function<bool()>& condition, const std::function<void()>& meanwhile = [] {}) {
    for (const double end_s = steadyNow_s() + 20.0; steadyNow_s() < end_s;) {
      meanwhile();
      device_->poll(0.002, [this](const RangeReading& reading) { readings_.push_back(reading); });
      if (condition()) return true;
    }
    return false;
  }

  void sendFrame() { terminal_->write(bytesOf(sent_++)); }
  LinkState state() const { return device_->status().state; }

  std::unique_ptr<serial::PseudoTerminal> terminal_ = std::make_unique<serial::PseudoTerminal>();
  std::unique_ptr<RangeDevice> device_;
  std::vector<RangeReading> readings_;
  std::uint64_t sent_ = 0;
};

TEST_F(RangeDeviceTest, DeliversReadingsWithGrowingStampsOfThePast) {
  begin(terminal_->path());
  ASSERT_TRUE(pollUntil([&] { return readings_.size() >= 100; }, [&] { sendFrame(); }));
  for (std::size_t i = 0; i < readings_.size(); ++i) {
    EXPECT_TRUE(same(readings_[i].measurement, measurementOf(i))) << i;
    EXPECT_NEAR(readings_[i].range_m, 0.01 * measurementOf(i).distance_cm, 1e-9);
    EXPECT_LT(readings_[i].time_s, steadyNow_s());
    if (i > 0) {
      EXPECT_GT(readings_[i].time_s, readings_[i - 1].time_s);
    }
  }
  EXPECT_EQ(state(), LinkState::kStreaming);
  EXPECT_EQ(device_->status().last.strength, measurementOf(readings_.size() - 1).strength);
}

TEST_F(RangeDeviceTest, ResumesAfterUnpluggingAndSilence) {
  const std::string link = testing::TempDir() + "range_device_test_port";
  terminal_->link(link);
  begin(link);
  ASSERT_TRUE(pollUntil([&] { return state() == LinkState::kStreaming; }, [&] { sendFrame(); }));
  terminal_.reset();
  ASSERT_TRUE(pollUntil([&] { return state() == LinkState::kDisconnected; }));
  terminal_ = std::make_unique<serial::PseudoTerminal>();
  terminal_->link(link);
  ASSERT_TRUE(pollUntil([&] { return state() == LinkState::kStreaming; }, [&] { sendFrame(); }));
  EXPECT_EQ(device_->status().connections, 2U);
  ASSERT_TRUE(pollUntil([&] { return state() == LinkState::kSilent; }));
  EXPECT_NE(device_->status().message.find("no bytes"), std::string::npos);
  ASSERT_TRUE(pollUntil([&] { return state() == LinkState::kStreaming; }, [&] { sendFrame(); }));
}

TEST_F(RangeDeviceTest, BytesWithoutFramesPointToBaudRateAndFormat) {
  begin(terminal_->path());
  ASSERT_TRUE(pollUntil([&] { return state() == LinkState::kNoFrames; },
                        [&] {
                          terminal_->write({'1', '.', '2'});
                        }));
  EXPECT_NE(device_->status().message.find("baud rate"), std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::range
