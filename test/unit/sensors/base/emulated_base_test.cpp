#include "sensors/base/emulation/emulated_base.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/sensors/base/base_messages.h"

namespace stereo_nav::base {
namespace {

class EmulatedBaseTest : public testing::Test {
 protected:
  void make(bool steered) {
    EmulatedBaseParams params;
    params.wheels.resize(2);
    for (auto& wheel : params.wheels) wheel.steered = steered;
    params.wheels[1].metres_per_pulse *= -1.0;
    params.ranges_mm = {1500};
    params.switches = 2;
    base_ = std::make_unique<EmulatedBase>(params);
  }

  void command(std::int16_t speed_mm_per_s, std::int32_t steering_urad) {
    Command c{};
    c.sequence = sequence_++;
    c.valid_ms = kMaxValid_ms;
    c.wheels = 2;
    for (int i = 0; i < 2; ++i) {
      c.speed_mm_per_s[i] = speed_mm_per_s;
      c.steering_urad[i] = steering_urad;
    }
    for (const std::uint8_t byte : encoded(c)) base_->receive(byte);
  }

  void advance(double time_s) {
    base_->advance(time_s, [this](const Bytes& frame, double) {
      for (const auto& telemetry : parse(parser_, frame)) last_ = telemetry;
    });
  }

  void driveUntil(double end_s, std::int16_t speed_mm_per_s, std::int32_t steering_urad) {
    for (; time_s_ < end_s; time_s_ += 0.02) {
      command(speed_mm_per_s, steering_urad);
      advance(time_s_);
    }
  }

  std::unique_ptr<EmulatedBase> base_;
  FrameParser<Telemetry, Crc32> parser_;
  Telemetry last_{};
  std::uint16_t sequence_ = 0;
  double time_s_ = 0.0;
};

TEST_F(EmulatedBaseTest, DrivesAsCommandedAndCountsIt) {
  make(false);
  driveUntil(2.0, 500, 0);
  EXPECT_NEAR(base_->wheels()[0].speed_m_per_s(), 0.5, 0.01);
  EXPECT_NEAR(last_.pulses[0] * 0.0005, base_->wheels()[0].way_m(), 0.02);
  EXPECT_NEAR(last_.pulses[1] * -0.0005, base_->wheels()[1].way_m(), 0.02);
  EXPECT_EQ(last_.steering_urad[0], 0);
  EXPECT_EQ(last_.range_mm[0], 1500);
  EXPECT_EQ(last_.switches, 2);
  EXPECT_EQ(parser_.counters().lost, 0U);
  EXPECT_NEAR(static_cast<double>(parser_.counters().delivered), 200.0, 3.0);
}

TEST_F(EmulatedBaseTest, SteersAtItsRate) {
  make(true);
  driveUntil(0.1, 0, 1500000);
  EXPECT_NEAR(last_.steering_urad[0], 0.8e6, 0.25e6);
  driveUntil(1.0, 0, 1500000);
  EXPECT_NEAR(last_.steering_urad[0], 1.5e6, 3e3);
}

/// Nothing turns before the first command, and a stop ends the turning of the axes, too.
TEST_F(EmulatedBaseTest, AnAxisIsHeldWhereItIsWhileNothingIsCommanded) {
  make(true);
  advance(0.5);
  EXPECT_EQ(last_.steering_urad[0], 0);
  time_s_ = 0.5;
  driveUntil(0.6, 0, 3000000);
  advance(3.0);
  EXPECT_EQ(base_->controller().mode(), Mode::kTimedOut);
  const std::int32_t held = last_.steering_urad[0];
  EXPECT_GT(held, 500000);
  EXPECT_LT(held, 2900000 * 1.04) << "0.3 s after the last command it was still on its way or just there";
  advance(5.0);
  EXPECT_NEAR(last_.steering_urad[0], held, 1e3);
}

/// v x 0.3 s until the watchdog, then v^2 / (2 a), and what the lag adds.
TEST_F(EmulatedBaseTest, StopsWithinItsStoppingDistanceWhenTheHostFallsSilent) {
  for (const int speed_mm_per_s : {300, 1000}) {
    make(false);
    time_s_ = 0.0;
    driveUntil(3.0, static_cast<std::int16_t>(speed_mm_per_s), 0);
    const double from_m = base_->wheels()[0].way_m();
    const double v = base_->wheels()[0].speed_m_per_s();
    advance(time_s_ - 0.02 + 2.0);
    EXPECT_EQ(base_->controller().mode(), Mode::kTimedOut);
    EXPECT_NEAR(base_->wheels()[0].speed_m_per_s(), 0.0, 1e-3);
    EXPECT_LE(base_->wheels()[0].way_m() - from_m, v * 0.35 + v * v / (2.0 * 3.0) + 0.02) << v;
  }
}

}  // namespace
}  // namespace stereo_nav::base
