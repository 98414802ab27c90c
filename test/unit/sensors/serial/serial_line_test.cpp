#include "sensors/serial/emulation/serial_line.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace stereo_nav::serial {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(SerialLine, BytesTakeTenBitTimesEach) {
  SerialLine line(10000, 0.0);
  line.send(Bytes(5, 7), 1.0);
  Bytes out;
  line.collect(1.0025, out);
  EXPECT_EQ(out.size(), 2U);
  EXPECT_NEAR(line.backlog_s(1.0025), 0.0025, 1e-12);
  line.collect(1.00501, out);
  EXPECT_EQ(out.size(), 5U);
}

TEST(SerialLine, AnAdapterHandsOverInBatches) {
  SerialLine line(115200, 0.016);
  line.send(Bytes(15, 7), 0.0161);
  Bytes out;
  line.collect(0.0319, out);
  EXPECT_TRUE(out.empty());
  line.collect(0.0321, out);
  EXPECT_EQ(out.size(), 15U);
}

TEST(MismatchedReceiver, EqualRatesChangeNothing) {
  std::mt19937 random(1);
  Bytes sent;
  for (int i = 0; i < 1000; ++i) sent.push_back(static_cast<std::uint8_t>(random()));
  // Serial lines tolerate a few per cent.
  for (const int receiver_baud : {115200, 117000, 113000}) {
    MismatchedReceiver receiver(115200, receiver_baud);
    Bytes out;
    receiver.receive(sent, out);
    receiver.receive({0xFF, 0xFF}, out);
    ASSERT_GE(out.size(), sent.size());
    EXPECT_EQ(Bytes(out.begin(), out.begin() + 1000), sent) << receiver_baud;
  }
}

TEST(MismatchedReceiver, OtherRatesGiveOtherBytes) {
  for (const int receiver_baud : {9600, 57600, 230400, 1000000}) {
    MismatchedReceiver receiver(115200, receiver_baud);
    Bytes out;
    for (int i = 0; i < 100; ++i) receiver.receive({'i', 't', 's', 0x00, 0x11, 0x80, 0x42}, out);
    EXPECT_GT(out.size(), 10U);
    const std::string text(out.begin(), out.end());
    EXPECT_EQ(text.find("its"), std::string::npos) << receiver_baud;
  }
}

TEST(LineFaults, DamageTheShareTheyAreTold) {
  LineFaults faults(0.01, 0.02, 5);
  const Bytes sent(1, 0x55);
  std::size_t corrupt = 0, lost = 0, intact = 0;
  for (int i = 0; i < 100000; ++i) {
    Bytes out;
    intact += faults.pass(sent.data(), 1, out);
    lost += out.empty();
    corrupt += !out.empty() && out[0] != 0x55;
  }
  EXPECT_NEAR(static_cast<double>(corrupt), 1000, 150);
  EXPECT_NEAR(static_cast<double>(lost), 2000, 200);
  EXPECT_EQ(intact + corrupt + lost, 100000U);
}

}  // namespace
}  // namespace stereo_nav::serial
