#include "sensors/imu/phone_protocol.h"

#include <gtest/gtest.h>

namespace stereo_nav::imu {
namespace {

std::optional<PhoneSample> parse(const std::string& text) {
  return parsePhoneText(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

TEST(PhoneText, AxesBecomeThoseOfThePhoneThatLiesFlat) {
  const auto sample = parse("890.71558, 3,  0.100, 0.200, 9.810, 4, 0.010,-0.020, 0.030, 5, 18.0,-7.0,-40.0");
  ASSERT_TRUE(sample.has_value());
  EXPECT_DOUBLE_EQ(sample->time_s, 890.71558);
  // Forward is Android's y, left its -x.
  EXPECT_TRUE(sample->measurement.linear_acceleration.isApprox(Eigen::Vector3d(0.2, -0.1, 9.81)));
  EXPECT_TRUE(sample->measurement.angular_velocity.isApprox(Eigen::Vector3d(-0.02, -0.01, 0.03)));
  EXPECT_TRUE(sample->measurement.magnetic_field->isApprox(Eigen::Vector3d(-7.0, -18.0, -40.0)));
}

TEST(PhoneText, OtherSensorsAreSkipped) {
  const auto sample = parse(
      "1.5, 1, 49.1, 8.2, 110, 8, 1518819953744, 3, 0, 0, 9.8, 85, 1013.2, 4, 0, 0, 0.5, 84, 0.1, 0.2, 0.3, 86, 31\n");
  ASSERT_TRUE(sample.has_value());
  EXPECT_DOUBLE_EQ(sample->measurement.angular_velocity.z(), 0.5);
  EXPECT_FALSE(sample->measurement.magnetic_field.has_value());
}

TEST(PhoneText, WhatIsNoMeasurementIsRefused) {
  for (const char* text :
       {"", ",", "abc", "1.0", "1.0, 3, 0, 0, 9.8", "1.0, 4, 0, 0, 0.5", "1.0, 3, 0, 0, 9.8, 4, 0, 0",
        "1.0, 3, 0, 0, nan, 4, 0, 0, 0", "1.0, 3, 0, 0, 1e999, 4, 0, 0, 0", "1.0, 3, 0, 0, 9.8, 4, 0, 0, 500",
        "-1.0, 3, 0, 0, 9.8, 4, 0, 0, 0", "1.0, 3, 0, 0, 9.8, 4, 0, 0, 0x1",
        "1.0, 3, 0, 0, 9.8, 4, 0, 0, 0 1", "1.0, 3, 0, 0, 9.8, 4, 0, 0, 1,",
        "1.0; 3; 0; 0; 9.8; 4; 0; 0; 0"}) {
    EXPECT_FALSE(parse(text).has_value()) << text;
  }
  EXPECT_FALSE(parse(std::string("1.0, 3, 0, 0, 9.8, 4, 0, 0, 1\0", 30)).has_value()) << "a zero byte";
}

TEST(PhoneText, DamageToAnyByteNeverGivesWhatNoSensorMeasures) {
  PhoneSample sample;
  sample.time_s = 17.25;
  sample.measurement.linear_acceleration = {0.5, -0.25, 9.75};
  sample.measurement.angular_velocity = {0.125, -0.5, 1.0};
  const std::string text = phoneText(sample);
  ASSERT_TRUE(parse(text).has_value());
  EXPECT_TRUE(parse(text)->measurement.linear_acceleration.isApprox(sample.measurement.linear_acceleration));
  std::size_t refused = 0;
  for (std::size_t byte = 0; byte < text.size(); ++byte) {
    for (unsigned difference = 1; difference < 256; ++difference) {
      std::string damaged = text;
      damaged[byte] = static_cast<char>(damaged[byte] ^ difference);
      const auto parsed = parse(damaged);
      if (!parsed) {
        ++refused;
      } else {
        EXPECT_TRUE(raw_protocol::possible(parsed->measurement)) << damaged;
      }
    }
  }
  EXPECT_GT(static_cast<double>(refused), 0.9 * static_cast<double>(text.size()) * 255.0)
      << "all but those that make another digit of a digit";
}

}  // namespace
}  // namespace stereo_nav::imu
