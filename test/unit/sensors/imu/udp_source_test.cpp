#include "sensors/imu/udp_source.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>

#include "sensors/imu/emulation/datagram_line.h"
#include "sensors/imu/emulation/emulated_module.h"
#include "sensors/imu/imu_device.h"
#include "sensors/serial/serial_port.h"
#include "sensors/serial/steady_clock.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::imu {
namespace {

using serial::steadyNow_s;

constexpr std::uint16_t kTestPort = 45683;
const UdpAddress kLoopback{"127.0.0.1", kTestPort};

TEST(UdpAddress, IsLoopbackUnlessToldOtherwise) {
  EXPECT_EQ(parseUdpAddress("udp:5555")->text(), "127.0.0.1:5555");
  EXPECT_EQ(parseUdpAddress("udp:0.0.0.0:5555")->text(), "0.0.0.0:5555");
  EXPECT_FALSE(parseUdpAddress("/dev/ttyUSB0").has_value());
  for (const char* text :
       {"udp:", "udp:0", "udp:65536", "udp:x:5555", "udp:1.2.3.4:", "udp:1.2.3.4:5:6", "udp:-5"}) {
    EXPECT_THROW(parseUdpAddress(text), ParameterError) << text;
  }
}

TEST(UdpSource, DeliversOneDatagramARead) {
  UdpSource source(kLoopback);
  DatagramLine line({kLoopback});
  line.send({1, 2, 3});
  line.send({4});
  std::array<std::uint8_t, 64> buffer{};
  EXPECT_EQ(source.read(buffer.data(), buffer.size(), 5.0), 3U);
  EXPECT_EQ(source.read(buffer.data(), buffer.size(), 5.0), 1U);
  EXPECT_EQ(buffer[0], 4);
  EXPECT_EQ(source.read(buffer.data(), buffer.size(), 0.0), 0U);
}

TEST(UdpSource, SaysWhyAPortCannotBeHad) {
  const UdpSource first(kLoopback);
  try {
    const UdpSource second(kLoopback);
    FAIL() << "the port is in use";
  } catch (const serial::SerialError& error) {
    EXPECT_EQ(error.fault(), serial::PortFault::kBusy);
    EXPECT_NE(std::string(error.what()).find("another program does"), std::string::npos);
  }
  try {
    const UdpSource elsewhere({"192.0.2.1", kTestPort});  // an address for documents, RFC 5737
    FAIL() << "no computer has this address";
  } catch (const serial::SerialError& error) {
    EXPECT_NE(std::string(error.what()).find("no such address"), std::string::npos);
  }
}

/// A device and a phone or module that sends to it over a network with faults.
class UdpDeviceTest : public testing::TestWithParam<Protocol> {
 protected:
  bool pollUntil(
      const std::function<bool()>& condition, const std::function<void()>& meanwhile = [] {}) {
    for (const double end_s = steadyNow_s() + 20.0; steadyNow_s() < end_s;) {
      meanwhile();
      device_.poll(0.002, [this](const ImuReading& reading) { readings_.push_back(reading); });
      if (condition()) return true;
    }
    return false;
  }

  void sendFrame() {
    module_time_s_ += 0.01;
    line_.send(module_.frame(constantRates({}, {})(0.0), module_time_s_));
  }

  static ImuDeviceParams params() {
    ImuDeviceParams params;
    params.protocol = GetParam();
    return params;
  }

  DatagramLine line_{{kLoopback, 0.1, 0.1, 0.1, 0.0, 3}};
  EmulatedModule module_{GetParam(), AngleOrder::kYawPitchRoll, false, ModuleErrors(), 1};
  double module_time_s_ = 0.0;
  std::vector<ImuReading> readings_;
  ImuDevice device_{params(), serial::PortFinder("udp:" + std::to_string(kTestPort), "/nonexistent")};
};

TEST_P(UdpDeviceTest, StreamsThroughLossAndReorderingAndResumes) {
  EXPECT_TRUE(pollUntil([&] { return readings_.size() > 100; }, [&] { sendFrame(); }));
  for (std::size_t i = 1; i < readings_.size(); ++i) EXPECT_GT(readings_[i].time_s, readings_[i - 1].time_s);
  const ImuDeviceStatus status = device_.status();
  EXPECT_EQ(status.state, serial::LinkState::kStreaming);
  EXPECT_GT(status.counters.late_frames, 0U);
  EXPECT_GT(status.counters.lost_frames, 0U);
  EXPECT_NEAR(readings_[0].raw->linear_acceleration.z(), 9.80665, 1e-3);
  ASSERT_TRUE(pollUntil([&] { return device_.status().state == serial::LinkState::kSilent; }));
  EXPECT_NE(device_.status().message.find("Only this computer is heard"), std::string::npos);
  EXPECT_TRUE(pollUntil([&] { return device_.status().state == serial::LinkState::kStreaming; },
                        [&] { sendFrame(); }));
}

TEST_P(UdpDeviceTest, DatagramsWithoutMeasurementsAreExplained) {
  EXPECT_TRUE(pollUntil([&] { return device_.status().state == serial::LinkState::kNoFrames; },
                        [&] {
                          line_.send({'1', ',', '3'});
                        }));
  EXPECT_NE(device_.status().message.find("switched on in the app"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Protocols, UdpDeviceTest, testing::Values(Protocol::kRaw, Protocol::kPhone));

TEST(UdpDevice, RefusesWhatDoesNotGoTogether) {
  ImuDeviceParams params;
  EXPECT_THROW(ImuDevice(params, serial::PortFinder("udp:5555")), ParameterError) << "angles over UDP";
  params.protocol = Protocol::kPhone;
  EXPECT_THROW(ImuDevice(params, serial::PortFinder("/dev/ttyUSB0")), ParameterError)
      << "a phone on a serial port";
}

}  // namespace
}  // namespace stereo_nav::imu
