#include "sensors/laser/rplidar_protocol.h"

#include <gtest/gtest.h>

namespace stereo_nav::laser {
namespace {

using rplidar::Command;

TEST(RplidarProtocol, NodesAreAsDocumented) {
  const std::vector<std::uint8_t> bytes = {0xBE, 0x01, 0x2D, 0xA0, 0x0F};
  const auto node = rplidar::decodeNode(bytes.data());
  ASSERT_TRUE(node.has_value());
  EXPECT_FALSE(node->start);
  EXPECT_EQ(node->quality, 47);
  EXPECT_DOUBLE_EQ(node->heading_deg, 90.0);
  EXPECT_DOUBLE_EQ(node->distance_mm, 1000.0);
  std::vector<std::uint8_t> again(rplidar::kNodeBytes);
  rplidar::encodeNode(*node, again.data());
  EXPECT_EQ(again, bytes);
}

TEST(RplidarProtocol, CheckBitsAndHeadingsAreChecked) {
  const auto decodes = [](std::uint8_t first, std::uint8_t second, std::uint8_t third) {
    const std::uint8_t bytes[] = {first, second, third, 0, 0};
    return rplidar::decodeNode(bytes).has_value();
  };
  EXPECT_TRUE(decodes(0x01, 0x01, 0x00));
  EXPECT_FALSE(decodes(0x03, 0x01, 0x00)) << "start and not start";
  EXPECT_FALSE(decodes(0x00, 0x01, 0x00)) << "neither";
  EXPECT_FALSE(decodes(0x01, 0x00, 0x00)) << "check bit missing";
  EXPECT_TRUE(decodes(0x01, 0xFF, 0xB3)) << "359.98 degrees";
  EXPECT_FALSE(decodes(0x01, 0x01, 0xB4)) << "360 degrees";
}

TEST(RplidarProtocol, AHeadingThatIsRoundedUpToAFullTurnIsZero) {
  std::vector<std::uint8_t> bytes(rplidar::kNodeBytes);
  ScanNode node;
  node.heading_deg = 359.999;
  rplidar::encodeNode(node, bytes.data());
  EXPECT_EQ(rplidar::decodeNode(bytes.data())->heading_deg, 0.0);
}

TEST(RplidarProtocol, RequestsAndDescriptorsAreAsDocumented) {
  EXPECT_EQ(rplidar::request(Command::kScan), (std::array<std::uint8_t, 2>{0xA5, 0x20}));
  EXPECT_EQ(rplidar::request(Command::kStop), (std::array<std::uint8_t, 2>{0xA5, 0x25}));
  EXPECT_EQ(rplidar::descriptor(Command::kScan), (rplidar::Descriptor{0xA5, 0x5A, 0x05, 0, 0, 0x40, 0x81}));
  EXPECT_EQ(rplidar::descriptor(Command::kGetHealth), (rplidar::Descriptor{0xA5, 0x5A, 0x03, 0, 0, 0, 0x06}));
  EXPECT_EQ(rplidar::descriptor(Command::kGetInfo), (rplidar::Descriptor{0xA5, 0x5A, 0x14, 0, 0, 0, 0x04}));
}

TEST(RplidarProtocol, InfoAndHealthSurviveTheLine) {
  DeviceInfo info;
  info.model = 24;
  info.firmware_major = 1;
  info.firmware_minor = 5;
  info.hardware = 7;
  info.serial_number.fill(0xAB);
  EXPECT_EQ(rplidar::decodeInfo(rplidar::encodeInfo(info).data()).text(),
            "model 24, firmware 1.05, hardware 7, serial number ABABABABABABABABABABABABABABABAB");
  const DeviceHealth health =
      rplidar::decodeHealth(rplidar::encodeHealth({DeviceHealth::Status::kError, 0x8001}).data());
  EXPECT_EQ(health.status, DeviceHealth::Status::kError);
  EXPECT_EQ(health.error_code, 0x8001);
}

}  // namespace
}  // namespace stereo_nav::laser
