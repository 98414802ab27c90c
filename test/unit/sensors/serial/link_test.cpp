#include "sensors/serial/link.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <memory>
#include <string>

#include "sensors/serial/emulation/pseudo_terminal.h"
#include "sensors/serial/steady_clock.h"

namespace stereo_nav::serial {
namespace {

/// A link to a port that appears and disappears; every byte counts as a frame.
class LinkTest : public testing::Test {
 protected:
  bool readUntil(
      const std::function<bool()>& condition, const std::function<void()>& meanwhile = [] {}) {
    for (const double end_s = steadyNow_s() + 20.0; steadyNow_s() < end_s;) {
      meanwhile();
      std::array<std::uint8_t, 64> buffer{};
      const std::size_t size = link_.read(buffer.data(), buffer.size(), 0.002);
      if (size > 0) link_.delivered();
      if (condition()) return true;
    }
    return false;
  }

  std::shared_ptr<ByteSource> open() {
    auto port = std::make_shared<SerialPort>(path_, 115200);
    port_ = port;
    if (refuse_) throw SerialError(PortFault::kOther, "it says nothing of itself");
    return port;
  }

  LinkState state() const { return link_.status().state; }

  std::string path_ = testing::TempDir() + "link_test_port";
  bool refuse_ = false;
  std::weak_ptr<SerialPort> port_;
  Link link_{{0.05, 0.1}, [this] { return open(); }};
};

TEST_F(LinkTest, CountsEachTimeThatTheDeviceAppears) {
  for (std::uint64_t connection = 1; connection <= 2; ++connection) {
    auto terminal = std::make_unique<PseudoTerminal>();
    terminal->link(path_);
    ASSERT_TRUE(readUntil([&] { return state() == LinkState::kStreaming; }, [&] { terminal->write({7}); }));
    EXPECT_EQ(link_.status().connections, connection);
    EXPECT_FALSE(port_.expired());
    terminal.reset();
    ASSERT_TRUE(readUntil([&] { return state() == LinkState::kDisconnected; }));
    EXPECT_TRUE(port_.expired());
  }
}

TEST_F(LinkTest, ReopensASilentPortAsTheSameConnection) {
  PseudoTerminal terminal;
  terminal.link(path_);
  ASSERT_TRUE(readUntil([&] { return !port_.expired(); }));
  const std::weak_ptr<SerialPort> first = port_;
  ASSERT_TRUE(readUntil([&] { return first.expired() && state() == LinkState::kSilent; }));
  ASSERT_TRUE(readUntil([&] { return state() == LinkState::kStreaming; }, [&] { terminal.write({7}); }));
  EXPECT_EQ(link_.status().connections, 1U);
}

TEST_F(LinkTest, AFaultMetByTheCallerClosesThePortUntilTheNextAttempt) {
  PseudoTerminal terminal;
  terminal.link(path_);
  ASSERT_TRUE(readUntil([&] { return state() == LinkState::kStreaming; }, [&] { terminal.write({7}); }));
  link_.disconnect(SerialError(PortFault::kLost, "it takes no bytes"));
  EXPECT_EQ(state(), LinkState::kDisconnected);
  EXPECT_EQ(link_.status().fault, "it takes no bytes");
  ASSERT_TRUE(readUntil([&] { return state() == LinkState::kStreaming; }, [&] { terminal.write({7}); }));
  EXPECT_EQ(link_.status().connections, 2U);
}

TEST_F(LinkTest, AnOpeningThatFailsHalfWayIsTriedAgain) {
  PseudoTerminal terminal;
  terminal.link(path_);
  refuse_ = true;
  ASSERT_TRUE(readUntil([&] { return link_.status().fault == "it says nothing of itself"; }));
  EXPECT_EQ(link_.status().connections, 0U);
  refuse_ = false;
  EXPECT_TRUE(readUntil([&] { return state() == LinkState::kStreaming; }, [&] { terminal.write({7}); }));
}

}  // namespace
}  // namespace stereo_nav::serial
