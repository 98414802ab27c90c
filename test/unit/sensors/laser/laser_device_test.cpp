#include "sensors/laser/laser_device.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "sensors/laser/emulation/emulated_scanner.h"
#include "sensors/serial/emulation/emulated_adapter.h"
#include "sensors/serial/steady_clock.h"
#include "unit/sensors/laser/modem_lines.h"

namespace stereo_nav::laser {
namespace {

using serial::LinkState;
using serial::steadyNow_s;

/// Drives a device from one thread together with the scanner and the adapter that it listens to.
class LaserDeviceTest : public testing::Test {
 protected:
  void SetUp() override {
    forgetDtr();
    adapter_options_.links = {testing::TempDir() + "laser_device_test_port"};
    params_.link.retry_s = 0.05;
  }

  void begin() {
    adapter_ = std::make_unique<serial::EmulatedAdapter>(adapter_options_);
    start_s_ = steadyNow_s();
    adapter_->start(start_s_);
    device_ =
        std::make_unique<LaserDevice>(params_, serial::PortFinder(adapter_options_.links[0], "/nonexistent"));
  }

  /// Polls until the condition holds. The limit is generous, since polling ends as soon as it holds.
  bool pollUntil(const std::function<bool()>& condition) {
    for (const double end_s = steadyNow_s() + 30.0; steadyNow_s() < end_s;) {
      work();
      device_->poll(0.002, [this](const Scan& scan) { scans_.push_back(scan); });
      if (condition()) return true;
    }
    return false;
  }

  void work() {
    const double now_s = steadyNow_s() - start_s_;
    for (const auto& reply : scanner_.receive(adapter_->received(), now_s)) {
      adapter_->send(reply.bytes, start_s_ + reply.time_s);
    }
    for (const auto& node : scanner_.advance(now_s)) {
      if (!silent_) adapter_->send(node.bytes, start_s_ + node.time_s);
    }
    adapter_->handOver(steadyNow_s());
  }

  LinkState state() const { return device_->status().state; }
  std::string message() const { return device_->status().message; }

  serial::AdapterOptions adapter_options_;
  LaserDeviceParams params_;
  ScannerOptions scanner_options_;
  EmulatedScanner scanner_{scanner_options_};
  std::unique_ptr<serial::EmulatedAdapter> adapter_;
  std::unique_ptr<LaserDevice> device_;
  std::vector<Scan> scans_;
  double start_s_ = 0.0;
  bool silent_ = false;
};

TEST_F(LaserDeviceTest, ScansWithTheMotorOnAndStopsItAtTheEnd) {
  begin();
  ASSERT_TRUE(pollUntil([&] { return scans_.size() >= 5; })) << message();
  EXPECT_EQ(lastDtr(), 0) << "DTR off turns the motor";
  const LaserDeviceStatus status = device_->status();
  EXPECT_EQ(status.state, LinkState::kStreaming);
  EXPECT_EQ(status.scans, 5U);
  EXPECT_NE(status.info.find("firmware 1.29"), std::string::npos) << status.info;
  EXPECT_EQ(status.counters.dropped, 0U);
  EXPECT_NEAR(status.scan_rate_hz, 5.5, 0.5);
  for (std::size_t i = 1; i < scans_.size(); ++i) EXPECT_GT(scans_[i].time_s, scans_[i - 1].time_s);
  EXPECT_LT(scans_.back().time_s, steadyNow_s());
  device_.reset();
  EXPECT_EQ(lastDtr(), 1);
  work();
  EXPECT_FALSE(scanner_.scanning());
}

TEST_F(LaserDeviceTest, ResumesAfterUnplugging) {
  adapter_options_.unplug = {1.5, 0.5};
  begin();
  ASSERT_TRUE(pollUntil([&] { return state() == LinkState::kStreaming; }));
  ASSERT_TRUE(pollUntil([&] { return state() == LinkState::kDisconnected; }));
  scans_.clear();
  ASSERT_TRUE(pollUntil([&] { return scans_.size() >= 2; })) << message();
  EXPECT_EQ(device_->status().connections, 2U);
}

TEST_F(LaserDeviceTest, SaysThatAScannerDoesNotAnswer) {
  adapter_options_.drop_probability = 1.0;
  begin();
  ASSERT_TRUE(pollUntil([&] { return message().find("does not answer") != std::string::npos; })) << message();
}

TEST_F(LaserDeviceTest, SaysWhatTheScannerReportsAndResetsIt) {
  scanner_options_.error_code = 7;
  scanner_ = EmulatedScanner(scanner_options_);
  begin();
  ASSERT_TRUE(pollUntil([&] { return message().find("error code 7") != std::string::npos; })) << message();
  EXPECT_TRUE(pollUntil([&] { return !scans_.empty() && message() == "scanning"; })) << message();
}

TEST_F(LaserDeviceTest, AScanThatBreaksOffIsBegunAgain) {
  begin();
  ASSERT_TRUE(pollUntil([&] { return !scans_.empty(); }));
  silent_ = true;
  ASSERT_TRUE(pollUntil([&] { return state() == LinkState::kSilent; }));
  EXPECT_NE(message().find("motor"), std::string::npos);
  scanner_ = EmulatedScanner(scanner_options_);  // it was switched off and on, and is idle
  silent_ = false;
  scans_.clear();
  EXPECT_TRUE(pollUntil([&] { return !scans_.empty(); })) << message();
}

TEST_F(LaserDeviceTest, BytesThatAreNoNodesAreSaid) {
  begin();
  ASSERT_TRUE(pollUntil([&] { return !scans_.empty(); }));
  scanner_options_.scan_rate_hz = 1e-6;  // the head is blocked
  scanner_ = EmulatedScanner(scanner_options_);
  scanner_.receive({0xA5, 0x20}, steadyNow_s() - start_s_);
  ASSERT_TRUE(pollUntil([&] { return state() == LinkState::kNoFrames; }));
  EXPECT_NE(message().find("does the motor turn"), std::string::npos) << message();
}

}  // namespace
}  // namespace stereo_nav::laser
