#include <gtest/gtest.h>

#include <algorithm>

#include "estimation/ekf/fusion_setup.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::estimation::test {
namespace {

const char* const kWheels =
    "two_d_mode: true\n"
    "odom0: wheel/odom\n"
    "odom0_config: [false, false, false, false, false, false, true, true, false, false, false, true, false, false, false]\n";

FusionConfig read(const std::string& text) {
  return readFusionConfig(YAML::Load(text), "test.yaml");
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

bool noted(const FusionConfig& config, const std::string& text) {
  return std::any_of(config.notes.begin(), config.notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

std::string matrix(int values) {
  std::string text = "process_noise_covariance: [0.5";
  for (int i = 1; i < values; ++i) text += i % 16 == 0 ? ", 0.5" : ", 0";
  return text + "]\n";
}

TEST(FusionConfig, ReadsAFileOfRobotLocalization) {
  const FusionConfig config = read(
      std::string(kWheels) + matrix(225) +
      "acceleration_noise: 0.1\nfrequency: 50\nodom0_queue_size: 20\nodom0_twist_rejection_threshold: 3.5\n"
      "print_diagnostics: true\nuse_control: false\n");
  ASSERT_EQ(config.sensors.size(), 1u);
  EXPECT_EQ(config.sensors[0].topic, "wheel/odom");
  EXPECT_EQ(config.params.frequency_hz, 50.0);
  EXPECT_EQ(config.params.filter.noise().velocity.x(), 0.5);
  EXPECT_EQ(config.params.filter.noise().position.x(), 0.5);
  EXPECT_TRUE(config.notes.empty()) << config.notes.front();
  const FusionSetup setup = setUp(config);
  ASSERT_EQ(setup.channels.size(), 1u);
  EXPECT_EQ(setup.channels[0].gate, 3.5);
  EXPECT_EQ(setup.sensors[0].twist_fields, (std::vector<int>{0, 1, 5}));
}

TEST(FusionConfig, RefusesAMatrixOf255NumbersByName) {
  const std::string text = refusal(std::string(kWheels) + matrix(255));
  EXPECT_NE(text.find("process_noise_covariance must be a list of 225 numbers, it has 255"),
            std::string::npos)
      << text;
}

TEST(FusionConfig, RefusesByName) {
  EXPECT_NE(refusal(std::string(kWheels) + "odom0_confg: 1\n").find("confg"), std::string::npos);
  EXPECT_NE(refusal(std::string(kWheels) + "frequenzy: 1\n").find("frequenzy"), std::string::npos);
  EXPECT_NE(refusal("odom0: a\n").find("odom0_config is missing"), std::string::npos);
  EXPECT_NE(refusal("odom0_config: [true]\n").find("odom0 names no topic"), std::string::npos);
  EXPECT_NE(refusal("odom0: a\nodom0_config: [true, false]\n").find("15 times true or false, it has 2"),
            std::string::npos);
  EXPECT_NE(refusal("frequency: 30\n").find("no sensor"), std::string::npos);
  EXPECT_NE(refusal(std::string(kWheels) + "world_frame: earth\n").find("world_frame is 'earth'"),
            std::string::npos);
}

TEST(FusionConfig, ExplainsWhatHasNoEqual) {
  const FusionConfig config =
      read(std::string(kWheels) + "use_control: true\ndynamic_process_noise_covariance: true\n");
  EXPECT_TRUE(noted(config, "use_control has no equal here"));
  EXPECT_TRUE(noted(config, "dynamic_process_noise_covariance has no equal here"));
}

TEST(FusionConfig, PosesOfAnOdometryAreMotionsAndItsTwistWouldCountTwice) {
  const FusionConfig config = read(
      "odom0: a\n"
      "odom0_config: [true, true, false, false, false, true, true, true, false, false, false, true, false, false, false]\n");
  EXPECT_TRUE(noted(config, "only the motions count"));
  EXPECT_TRUE(noted(config, "would count each error twice"));
  const FusionSetup setup = setUp(config);
  ASSERT_EQ(setup.channels.size(), 1u);
  EXPECT_EQ(setup.channels[0].kind, Measurement::Kind::kMotion);
  EXPECT_EQ(setup.parts.anchors, 1);
}

TEST(FusionConfig, AnImuHasThreeChannels) {
  const FusionConfig config = read(
      "imu0: imu/data\nimu0_remove_gravitational_acceleration: true\n"
      "imu0_config: [false, false, false, true, true, false, false, false, false, true, true, true, true, true, true]\n");
  const FusionSetup setup = setUp(config);
  ASSERT_EQ(setup.channels.size(), 3u);
  EXPECT_TRUE(setup.parts.gyro);
  EXPECT_TRUE(setup.parts.accelerometer);
  EXPECT_TRUE(setup.channels[2].feels_gravity);
}

}  // namespace
}  // namespace stereo_nav::estimation::test
