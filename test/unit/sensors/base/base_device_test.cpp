#include "sensors/base/base_device.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "sensors/base/emulation/emulated_base.h"
#include "sensors/serial/emulation/pseudo_terminal.h"
#include "sensors/serial/steady_clock.h"
#include "unit/sensors/base/base_messages.h"

namespace stereo_nav::base {
namespace {

using serial::LinkState;
using serial::PseudoTerminal;
using serial::steadyNow_s;

/// Drives a device from one thread together with the base at the other end of its line.
class BaseDeviceTest : public testing::Test {
 protected:
  BaseDeviceTest() {
    EmulatedBaseParams params;
    params.wheels.resize(2);
    base_ = std::make_unique<EmulatedBase>(params);
  }

  void makeDevice(const std::string& path) {
    BaseDeviceParams params;
    params.link.retry_s = 0.05;
    params.link.reopen_silent_s = 0.1;
    device_ = std::make_unique<BaseDevice>(params, serial::PortFinder(path, "/nonexistent"));
    device_->poll(0.0, [](const BaseReading&) {});
  }

  Command driving() {
    Command command{};
    command.sequence = sequence_++;
    command.valid_ms = kMaxValid_ms;
    command.wheels = 2;
    command.speed_mm_per_s[0] = command.speed_mm_per_s[1] = 400;
    return command;
  }

  /// Polls until the condition holds. The limit is generous, since polling ends as soon as it holds.
  bool pollUntil(const std::function<bool()>& condition, bool base_runs = true) {
    for (const double end_s = steadyNow_s() + 20.0; steadyNow_s() < end_s;) {
      if (terminal_ && base_runs) runBase();
      device_->poll(0.002, [this](const BaseReading& reading) { readings_.push_back(reading); });
      if (condition()) return true;
    }
    return false;
  }

  void runBase() {
    for (const std::uint8_t byte : terminal_->read()) base_->receive(byte);
    base_->advance(steadyNow_s() - start_s_, [this](const Bytes& frame, double) { terminal_->write(frame); });
  }

  LinkState state() const { return device_->status().state; }

  std::unique_ptr<PseudoTerminal> terminal_ = std::make_unique<PseudoTerminal>();
  std::unique_ptr<EmulatedBase> base_;
  std::unique_ptr<BaseDevice> device_;
  std::vector<BaseReading> readings_;
  double start_s_ = steadyNow_s();
  std::uint16_t sequence_ = 0;
};

TEST_F(BaseDeviceTest, DeliversTelemetryWithGrowingStampsOfThePast) {
  makeDevice(terminal_->path());
  ASSERT_TRUE(pollUntil([&] { return readings_.size() >= 50; }));
  for (std::size_t i = 0; i < readings_.size(); ++i) {
    EXPECT_EQ(readings_[i].telemetry.wheels, 2);
    EXPECT_LT(readings_[i].time_s, readings_[i].arrival_s);
    if (i > 0) {
      EXPECT_GT(readings_[i].time_s, readings_[i - 1].time_s);
    }
  }
  EXPECT_EQ(state(), LinkState::kStreaming);
  EXPECT_EQ(device_->status().counters.lost, 0U);
}

TEST_F(BaseDeviceTest, CommandsReachTheBase) {
  makeDevice(terminal_->path());
  ASSERT_TRUE(pollUntil([&] { return !readings_.empty(); }));
  ASSERT_TRUE(pollUntil([&] {
    device_->send(driving());
    return readings_.back().telemetry.target_mm_per_s[1] == 400;
  }));
  EXPECT_EQ(readings_.back().telemetry.mode, static_cast<std::uint8_t>(Mode::kDriving));
  ASSERT_TRUE(pollUntil([&] { return readings_.back().telemetry.target_mm_per_s[1] == 0; }));
  EXPECT_EQ(readings_.back().telemetry.bad_commands, 0);
  EXPECT_EQ(device_->status().commands_unsent, 0U);
}

TEST_F(BaseDeviceTest, ResumesWhenTheBaseComesBackAndCountsWhatItCouldNotSend) {
  const std::string link = testing::TempDir() + "base_device_test_port";
  terminal_.reset();
  makeDevice(link);
  EXPECT_EQ(state(), LinkState::kDisconnected);
  EXPECT_NE(device_->status().message.find("does not exist"), std::string::npos);
  device_->send(driving());
  EXPECT_EQ(device_->status().commands_unsent, 1U);
  for (int connection = 1; connection <= 2; ++connection) {
    terminal_ = std::make_unique<PseudoTerminal>();
    terminal_->link(link);
    readings_.clear();
    ASSERT_TRUE(pollUntil([&] { return readings_.size() >= 5; }));
    EXPECT_EQ(device_->status().connections, static_cast<std::uint64_t>(connection));
    terminal_.reset();
    ASSERT_TRUE(pollUntil([&] {
      device_->send(driving());
      return state() == LinkState::kDisconnected;
    }));
  }
}

TEST_F(BaseDeviceTest, SaysThatItIsSilentAndResumes) {
  makeDevice(terminal_->path());
  ASSERT_TRUE(pollUntil([&] { return state() == LinkState::kStreaming; }));
  ASSERT_TRUE(pollUntil([&] { return state() == LinkState::kSilent; }, false));
  EXPECT_NE(device_->status().message.find("no bytes"), std::string::npos);
  ASSERT_TRUE(pollUntil([&] { return state() == LinkState::kStreaming; }));
  EXPECT_EQ(device_->status().connections, 1U);
}

TEST_F(BaseDeviceTest, AControllerThatIsSwitchedOffAndOnIsHeardAtOnce) {
  makeDevice(terminal_->path());
  ASSERT_TRUE(pollUntil([&] { return readings_.size() >= 20; }));
  ASSERT_TRUE(pollUntil([&, end_s = steadyNow_s() + 0.35] { return steadyNow_s() > end_s; }, false));
  EmulatedBaseParams params;
  params.wheels.resize(2);
  base_ = std::make_unique<EmulatedBase>(params);
  start_s_ = steadyNow_s();
  readings_.clear();
  ASSERT_TRUE(pollUntil([&] { return !readings_.empty(); }));
  EXPECT_EQ(device_->status().counters.stale, 0U);
}

TEST_F(BaseDeviceTest, BytesWithoutFramesPointToTheBaudRate) {
  makeDevice(terminal_->path());
  ASSERT_TRUE(pollUntil(
      [&] {
        terminal_->write({0x00, 0xF8, 0x69, 0x80, 0x1C});
        return state() == LinkState::kNoFrames;
      },
      false));
  EXPECT_NE(device_->status().message.find("check the baud rate (500000 here)"), std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::base
