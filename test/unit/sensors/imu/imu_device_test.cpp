#include "sensors/imu/imu_device.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include "sensors/imu/emulation/emulated_module.h"
#include "sensors/serial/emulation/pseudo_terminal.h"
#include "sensors/serial/serial_port.h"
#include "sensors/serial/steady_clock.h"

namespace stereo_nav::imu {
namespace {

/// Drives a device from one thread together with the module that it listens to.
class ImuDeviceTest : public testing::Test {
 protected:
  void makeDevice(const std::string& path, Protocol protocol = Protocol::kAngles) {
    ImuDeviceParams params;
    params.protocol = protocol;
    params.link.retry_s = 0.05;
    params.link.reopen_silent_s = 0.1;
    device_ = std::make_unique<ImuDevice>(params, serial::PortFinder(path, "/nonexistent"));
    module_ = std::make_unique<EmulatedModule>(protocol, AngleOrder::kYawPitchRoll, false, ModuleErrors(), 1);
  }

  void poll(double timeout_s) {
    device_->poll(timeout_s, [this](const ImuReading& reading) { readings_.push_back(reading); });
  }

  /// Polls until the condition holds. The limit is generous, since polling ends as soon as it holds.
  bool pollUntil(
      const std::function<bool()>& condition, const std::function<void()>& meanwhile = [] {}) {
    for (const double end_s = serial::steadyNow_s() + 20.0; serial::steadyNow_s() < end_s;) {
      meanwhile();
      poll(0.002);
      if (condition()) return true;
    }
    return false;
  }

  void sendFrame() {
    terminal_->write(module_->frame(constantRates({10.0, 2.0, -1.0}, {})(0.0), 0.002 * frames_sent_++));
  }

  serial::LinkState state() const { return device_->status().state; }

  std::unique_ptr<serial::PseudoTerminal> terminal_ = std::make_unique<serial::PseudoTerminal>();
  std::unique_ptr<ImuDevice> device_;
  std::unique_ptr<EmulatedModule> module_;
  std::vector<ImuReading> readings_;
  int frames_sent_ = 0;
};

TEST_F(ImuDeviceTest, DeliversAnglesWithGrowingStampsOfThePast) {
  makeDevice(terminal_->path());
  poll(0.0);
  ASSERT_TRUE(pollUntil([&] { return readings_.size() >= 100; }, [&] { sendFrame(); }));
  for (std::size_t i = 0; i < readings_.size(); ++i) {
    ASSERT_TRUE(readings_[i].angles.has_value());
    EXPECT_NEAR(readings_[i].angles->yaw_deg, 10.0, 1e-5);
    EXPECT_LT(readings_[i].time_s, serial::steadyNow_s());
    if (i > 0) {
      EXPECT_GT(readings_[i].time_s, readings_[i - 1].time_s);
    }
  }
  EXPECT_EQ(state(), serial::LinkState::kStreaming);
}

TEST_F(ImuDeviceTest, DeliversRawMeasurements) {
  makeDevice(terminal_->path(), Protocol::kRaw);
  poll(0.0);
  ASSERT_TRUE(pollUntil([&] { return readings_.size() >= 50; }, [&] { sendFrame(); }));
  EXPECT_TRUE(readings_[0].raw.has_value());
  EXPECT_EQ(device_->status().counters.lost_frames, 0U);
}

TEST_F(ImuDeviceTest, ResumesWhenTheModuleComesBack) {
  const std::string link = testing::TempDir() + "imu_device_test_port";
  makeDevice(link);
  poll(0.0);
  EXPECT_EQ(state(), serial::LinkState::kDisconnected);
  EXPECT_NE(device_->status().message.find("does not exist"), std::string::npos);
  for (int connection = 1; connection <= 2; ++connection) {
    terminal_ = std::make_unique<serial::PseudoTerminal>();
    terminal_->link(link);
    readings_.clear();
    ASSERT_TRUE(pollUntil([&] { return readings_.size() >= 20; }, [&] { sendFrame(); }));
    EXPECT_EQ(device_->status().connections, static_cast<std::uint64_t>(connection));
    terminal_.reset();
    ASSERT_TRUE(pollUntil([&] { return state() == serial::LinkState::kDisconnected; }));
  }
}

TEST_F(ImuDeviceTest, SaysThatItIsSilentAndResumes) {
  makeDevice(terminal_->path());
  poll(0.0);
  ASSERT_TRUE(pollUntil([&] { return state() == serial::LinkState::kStreaming; }, [&] { sendFrame(); }));
  ASSERT_TRUE(pollUntil([&] { return state() == serial::LinkState::kSilent; }));
  EXPECT_NE(device_->status().message.find("no bytes"), std::string::npos);
  // Several times the time after which the port is opened anew: still silent, still one connection.
  ASSERT_TRUE(pollUntil([&, end_s = serial::steadyNow_s() + 0.6] { return serial::steadyNow_s() > end_s; }));
  EXPECT_EQ(state(), serial::LinkState::kSilent);
  EXPECT_EQ(device_->status().connections, 1U);
  ASSERT_TRUE(pollUntil([&] { return state() == serial::LinkState::kStreaming; }, [&] { sendFrame(); }));
}

TEST_F(ImuDeviceTest, BytesWithoutFramesPointToTheBaudRate) {
  makeDevice(terminal_->path());
  poll(0.0);
  ASSERT_TRUE(pollUntil([&] { return state() == serial::LinkState::kNoFrames; },
                        [&] {
                          terminal_->write({0x00, 0xF8, 0x69, 0x80, 0x1C});
                        }));
  EXPECT_NE(device_->status().message.find("check the baud rate"), std::string::npos);
}

TEST_F(ImuDeviceTest, ABusyPortIsNamedAndTakenWhenFree) {
  auto other = std::make_unique<serial::SerialPort>(terminal_->path(), 115200);
  makeDevice(terminal_->path());
  poll(0.0);
  EXPECT_NE(device_->status().message.find("in use by another program"), std::string::npos);
  other.reset();
  EXPECT_TRUE(pollUntil([&] { return state() != serial::LinkState::kDisconnected; }));
}

TEST_F(ImuDeviceTest, APortWithoutPermissionNamesTheGroupAndIsTakenOnceAllowed) {
  // Root may open anything, so the test opens the port as another user then.
  const bool is_root = geteuid() == 0;
  constexpr uid_t kNobody = 65534;
  ASSERT_EQ(chmod(terminal_->path().c_str(), is_root ? 0600 : 0), 0);
  if (is_root) {
    ASSERT_EQ(seteuid(kNobody), 0);
  }
  makeDevice(terminal_->path());
  poll(0.0);
  const std::string message = device_->status().message;
  if (is_root) {
    ASSERT_EQ(seteuid(0), 0);
  }
  ASSERT_EQ(chmod(terminal_->path().c_str(), 0600), 0);
  EXPECT_NE(message.find("no permission to open " + terminal_->path()), std::string::npos) << message;
  EXPECT_NE(message.find("sudo usermod -aG"), std::string::npos) << message;
  EXPECT_TRUE(pollUntil([&] { return state() == serial::LinkState::kStreaming; }, [&] { sendFrame(); }));
}

}  // namespace
}  // namespace stereo_nav::imu
