#include "sensors/serial/serial_port.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <functional>
#include <memory>

#include "sensors/serial/emulation/pseudo_terminal.h"
#include "sensors/serial/port_finder.h"

namespace stereo_nav::serial {
namespace {

namespace fs = std::filesystem;

PortFault faultOf(const std::function<void()>& action, std::string* message = nullptr) {
  try {
    action();
  } catch (const SerialError& error) {
    if (message != nullptr) *message = error.what();
    return error.fault();
  }
  ADD_FAILURE() << "nothing was thrown";
  return PortFault::kOther;
}

TEST(SerialPort, BringsBytesAcrossUnchanged) {
  PseudoTerminal terminal;
  SerialPort port(terminal.path(), 115200);
  std::vector<std::uint8_t> sent;
  for (int i = 0; i < 256; ++i) sent.push_back(static_cast<std::uint8_t>(i));
  terminal.write(sent);
  std::vector<std::uint8_t> received;
  std::array<std::uint8_t, 64> buffer{};
  while (received.size() < sent.size()) {
    const std::size_t count = port.read(buffer.data(), buffer.size(), 5.0);
    ASSERT_GT(count, 0U);
    received.insert(received.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(count));
  }
  EXPECT_EQ(received, sent);
  EXPECT_EQ(port.read(buffer.data(), buffer.size(), 0.0), 0U);
}

TEST(SerialPort, WritesBytesUnchanged) {
  PseudoTerminal terminal;
  SerialPort port(terminal.path(), 115200);
  std::vector<std::uint8_t> sent;
  for (int i = 0; i < 256; ++i) sent.push_back(static_cast<std::uint8_t>(i));
  port.write(sent.data(), sent.size());
  EXPECT_EQ(terminal.read(), sent);
  EXPECT_TRUE(terminal.read().empty());
}

TEST(SerialPort, SaysWhenItCannotWrite) {
  auto terminal = std::make_unique<PseudoTerminal>();
  SerialPort port(terminal->path(), 115200);
  terminal.reset();
  const std::uint8_t byte = 0xA5;
  EXPECT_EQ(faultOf([&] { port.write(&byte, 1); }), PortFault::kLost);
}

TEST(SerialPort, SetsAnyBaudRate) {
  PseudoTerminal terminal;
  EXPECT_FALSE(terminal.baudRate().has_value());
  for (const int baud : {9600, 115200, 123456, 1000000}) {
    SerialPort port(terminal.path(), baud);
    EXPECT_EQ(terminal.baudRate(), baud);
  }
}

TEST(SerialPort, DiscardsWhatCameBefore) {
  PseudoTerminal terminal;
  SerialPort(terminal.path(), 115200);
  terminal.write({1, 2, 3});
  SerialPort port(terminal.path(), 115200);
  std::array<std::uint8_t, 8> buffer{};
  EXPECT_EQ(port.read(buffer.data(), buffer.size(), 0.0), 0U);
}

TEST(SerialPort, SaysWhenTheModuleIsUnplugged) {
  auto terminal = std::make_unique<PseudoTerminal>();
  SerialPort port(terminal->path(), 115200);
  terminal.reset();
  std::array<std::uint8_t, 8> buffer{};
  std::string message;
  EXPECT_EQ(faultOf([&] { port.read(buffer.data(), buffer.size(), 5.0); }, &message), PortFault::kLost);
  EXPECT_NE(message.find("unplugged"), std::string::npos);
}

TEST(SerialPort, RefusesAPortInUse) {
  PseudoTerminal terminal;
  const SerialPort first(terminal.path(), 115200);
  std::string message;
  EXPECT_EQ(faultOf([&] { SerialPort second(terminal.path(), 115200); }, &message), PortFault::kBusy);
  EXPECT_NE(message.find("another program"), std::string::npos);
}

TEST(SerialPort, RefusesWhatIsMissingOrNoSerialPort) {
  std::string message;
  EXPECT_EQ(faultOf([] { SerialPort port("/nonexistent/ttyUSB0", 115200); }, &message), PortFault::kMissing);
  EXPECT_NE(message.find("/dev/serial/by-id"), std::string::npos);
  EXPECT_EQ(faultOf([] { SerialPort port("/dev/null", 115200); }), PortFault::kNotSerial);
}

TEST(SerialPort, ExplainsPermissionAndBusyErrors) {
  const SerialError permission = explainOpenError("/dev/ttyUSB0", EACCES);
  EXPECT_EQ(permission.fault(), PortFault::kPermission);
  EXPECT_NE(std::string(permission.what()).find("usermod -aG dialout"), std::string::npos);
  EXPECT_EQ(explainOpenError("/dev/ttyUSB0", EBUSY).fault(), PortFault::kBusy);
  EXPECT_EQ(explainOpenError("/dev/ttyUSB0", EIO).fault(), PortFault::kOther);
}

class PortFinderTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_ / "by-id"); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  fs::path folder_ = fs::temp_directory_path() / ("port_finder_" + std::to_string(getpid()));
};

TEST_F(PortFinderTest, FollowsAnAdapterToAnotherIndex) {
  PortFinder finder(path("ttyUSB0"), path("by-id"));
  {
    PseudoTerminal first;
    first.link(path("ttyUSB0"));
    first.link(path("by-id/usb-module"));
    EXPECT_EQ(finder.locate(), path("ttyUSB0"));
    finder.remember();
  }
  EXPECT_EQ(finder.locate(), path("ttyUSB0")) << "nothing is plugged in";
  PseudoTerminal other;  // somebody else's adapter has taken the index
  other.link(path("ttyUSB0"));
  PseudoTerminal again;
  again.link(path("ttyUSB1"));
  again.link(path("by-id/usb-module"));
  EXPECT_EQ(finder.locate(), path("by-id/usb-module"));
}

TEST_F(PortFinderTest, WorksWithoutLastingNames) {
  PortFinder finder(path("ttyUSB0"), path("none"));
  PseudoTerminal terminal;
  terminal.link(path("ttyUSB0"));
  finder.remember();
  EXPECT_EQ(finder.locate(), path("ttyUSB0"));
}

}  // namespace
}  // namespace stereo_nav::serial
