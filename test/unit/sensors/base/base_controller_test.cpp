#include "sensors/base/controller/base_controller.h"

#include <gtest/gtest.h>

#include "unit/sensors/base/base_messages.h"

namespace stereo_nav::base {
namespace {

/// A controller with two wheels, a joint and an actuator, which is stepped every 10 ms.
class BaseControllerTest : public testing::Test {
 protected:
  static ControllerSetup setup() {
    ControllerSetup setup{};
    setup.wheels = 2;
    setup.joints = setup.actuators = 1;
    setup.metres_per_pulse[0] = setup.metres_per_pulse[1] = 0.001F;
    setup.gains.duty_per_speed = 0.5F;
    return setup;
  }

  Command command(std::int16_t speed_mm_per_s) {
    Command c{};
    c.sequence = ++sequence_;
    c.valid_ms = 300;
    c.wheels = 2;
    c.joints = c.actuators = 1;
    c.speed_mm_per_s[0] = c.speed_mm_per_s[1] = speed_mm_per_s;
    c.joint_urad[0] = 500000;
    c.actuator_permille[0] = 800;
    return c;
  }

  void give(const Command& c) {
    for (const std::uint8_t byte : encoded(c)) controller_.receive(byte, now_ms_);
  }

  const ControllerOutputs& stepUntil(std::uint32_t end_ms) {
    while (now_ms_ < end_ms) {
      now_ms_ += 10;
      outputs_ = controller_.step(inputs_, now_ms_, 0.01F);
    }
    return outputs_;
  }

  Telemetry telemetry() {
    Bytes frame(maxFrameBytes<Telemetry>());
    frame.resize(controller_.telemetry(inputs_, 1000 * now_ms_, frame.data()));
    FrameParser<Telemetry, Crc32> parser;
    const auto found = parse(parser, frame);
    EXPECT_EQ(found.size(), 1U);
    return found.empty() ? Telemetry{} : found[0];
  }

  BaseController controller_{setup()};
  ControllerInputs inputs_{};
  ControllerOutputs outputs_{};
  std::uint32_t now_ms_ = 0xFFFFFF00U;  // the clock wraps in every test
  std::uint16_t sequence_ = 0;
};

TEST_F(BaseControllerTest, StandsUntilItIsCommanded) {
  now_ms_ = 0;
  const auto& outputs = stepUntil(1000);
  EXPECT_EQ(controller_.mode(), Mode::kWaiting);
  EXPECT_EQ(outputs.duty[0], 0.0F);
  EXPECT_EQ(outputs.actuator_permille[0], 0);
}

TEST_F(BaseControllerTest, FollowsACommandForItsTimeAndNoLonger) {
  now_ms_ = 0;
  give(command(400));
  EXPECT_GT(stepUntil(290).duty[0], 0.1F);
  EXPECT_EQ(controller_.mode(), Mode::kDriving);
  EXPECT_EQ(controller_.heldSpeed_mm_per_s(1), 400);
  EXPECT_EQ(stepUntil(300).duty[0], 0.0F);
  EXPECT_EQ(controller_.mode(), Mode::kTimedOut);
  EXPECT_EQ(controller_.heldSpeed_mm_per_s(1), 0);
}

TEST_F(BaseControllerTest, TheClockMayWrap) {
  give(command(400));
  for (int i = 0; i < 29; ++i) outputs_ = controller_.step(inputs_, now_ms_ += 10, 0.01F);
  EXPECT_EQ(controller_.mode(), Mode::kDriving);
  outputs_ = controller_.step(inputs_, now_ms_ += 10, 0.01F);
  EXPECT_EQ(controller_.mode(), Mode::kTimedOut);
}

TEST_F(BaseControllerTest, RepeatingACommandDoesNotProlongIt) {
  now_ms_ = 0;
  for (int age_ms = 0; age_ms <= 300; age_ms += 20) {
    Command c = command(400);
    c.valid_ms = static_cast<std::uint16_t>(300 - age_ms);
    give(c);
    stepUntil(static_cast<std::uint32_t>(age_ms) + 20);
    EXPECT_EQ(controller_.heldSpeed_mm_per_s(0), age_ms < 280 ? 400 : 0) << age_ms;
  }
}

TEST_F(BaseControllerTest, NoCommandIsValidForLongerThanTheWatchdog) {
  now_ms_ = 0;
  Command c = command(400);
  c.valid_ms = 60000;
  give(c);
  stepUntil(kMaxValid_ms);
  EXPECT_EQ(controller_.mode(), Mode::kTimedOut);
}

TEST_F(BaseControllerTest, AStopWithoutJointsLeavesTheServosWhereTheyAre) {
  now_ms_ = 0;
  give(command(400));
  EXPECT_EQ(stepUntil(20).joint_urad[0], 500000);
  Command stop = command(0);
  stop.flags = kStop;
  stop.joints = 0;
  give(stop);
  EXPECT_EQ(stepUntil(40).joint_urad[0], 500000);
  EXPECT_EQ(controller_.mode(), Mode::kStopped);
  EXPECT_EQ(telemetry().command_sequence, stop.sequence);
}

TEST_F(BaseControllerTest, AStopHoldsUntilItIsReleased) {
  now_ms_ = 0;
  Command stop = command(400);
  stop.flags = kStop | kRelease;
  give(stop);
  stepUntil(10);
  EXPECT_EQ(controller_.mode(), Mode::kStopped);
  give(command(400));
  const auto& outputs = stepUntil(20);
  EXPECT_EQ(controller_.mode(), Mode::kStopped);
  EXPECT_EQ(outputs.duty[0], 0.0F);
  EXPECT_EQ(outputs.actuator_permille[0], 0);
  stepUntil(100000);
  EXPECT_EQ(controller_.mode(), Mode::kStopped) << "no time releases it";
  Command release = command(400);
  release.flags = kRelease;
  give(release);
  stepUntil(100010);
  EXPECT_EQ(controller_.mode(), Mode::kDriving);
}

TEST_F(BaseControllerTest, ActuatorsRestAndJointsHoldWhenTheHostFallsSilent) {
  now_ms_ = 0;
  Command c = command(0);
  c.valid_ms = 0;
  give(c);
  EXPECT_EQ(stepUntil(290).actuator_permille[0], 800) << "a base that stands may grip";
  EXPECT_EQ(stepUntil(300).actuator_permille[0], 0);
  EXPECT_EQ(outputs_.joint_urad[0], 500000);
}

TEST_F(BaseControllerTest, ACommandForAnotherBaseMovesNothingButItsStopStops) {
  now_ms_ = 0;
  Command c = command(400);
  c.wheels = 3;
  give(c);
  stepUntil(10);
  EXPECT_EQ(controller_.mode(), Mode::kWaiting);
  c.flags = kStop;
  c.sequence = ++sequence_;
  give(c);
  stepUntil(20);
  EXPECT_EQ(controller_.mode(), Mode::kStopped);
}

TEST_F(BaseControllerTest, AHostThatBeginsAgainIsHeardAfterTheWatchdog) {
  now_ms_ = 0;
  sequence_ = 20;
  give(command(400));
  sequence_ = 0;
  give(command(-400));
  stepUntil(10);
  EXPECT_EQ(controller_.heldSpeed_mm_per_s(0), 400) << "taken for a late one";
  stepUntil(310);
  give(command(-400));
  stepUntil(320);
  EXPECT_EQ(controller_.heldSpeed_mm_per_s(0), -400);
}

TEST_F(BaseControllerTest, TelemetryTellsWhatItMeasuresAndDoes) {
  now_ms_ = 0;
  inputs_.pulses[1] = -77;
  inputs_.switches = 5;
  inputs_.battery_mV = 11900;
  give(command(400));
  Bytes damaged = encoded(command(500));
  damaged[10] ^= 1;
  for (const std::uint8_t byte : damaged) controller_.receive(byte, now_ms_);
  ++sequence_;
  give(command(300));
  stepUntil(10);
  const Telemetry first = telemetry(), t = telemetry();
  EXPECT_EQ(t.sequence, first.sequence + 1);
  EXPECT_EQ(t.time_us, 10000U);
  EXPECT_EQ(t.command_sequence, sequence_);
  EXPECT_EQ(t.mode, static_cast<std::uint8_t>(Mode::kDriving));
  EXPECT_EQ(t.wheels, 2);
  EXPECT_EQ(t.pulses[1], -77);
  EXPECT_EQ(t.target_mm_per_s[0], 300);
  EXPECT_EQ(t.switches, 5);
  EXPECT_EQ(t.battery_mV, 11900);
  EXPECT_EQ(t.actuator_permille[0], 800);
  EXPECT_EQ(t.bad_commands, 1);
  EXPECT_EQ(t.lost_commands, 2);
}

}  // namespace
}  // namespace stereo_nav::base
