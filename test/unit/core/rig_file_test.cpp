#include "core/rig_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace stereo_nav {
namespace {

constexpr const char* kRig = R"(# Our robot. 20° of view are hidden by the arm.
cameras: {left: {device: /dev/video0}}
mounting:            # poses in base_link
  camera: {x_m: 0.1, y_m: 0.06, z_m: 0.283, roll_deg: 0.0, pitch_deg: 10.0, yaw_deg: 0.0}  # ± 1°
  imu: {x_m: 0.0, y_m: 0.0, z_m: 0.1, roll_deg: 0.0, pitch_deg: 0.0, yaw_deg: 0}   # under the laptop
disparity: {disparity_range: 64}
)";

SensorMounting turned(double roll_deg, double pitch_deg, double yaw_deg) {
  return {0.0, 0.0, 0.0, roll_deg, pitch_deg, yaw_deg};
}

Eigen::Matrix3d rotation(double roll_deg, double pitch_deg, double yaw_deg) {
  return turned(roll_deg, pitch_deg, yaw_deg).T_base_sensor().linear();
}

TEST(SensorMounting, AnglesTurnIntoRotationsAndBack) {
  SensorMounting back;
  back.setRotation(rotation(170.0, -60.0, -120.0));
  EXPECT_NEAR(back.roll_deg, 170.0, 1e-9);
  EXPECT_NEAR(back.pitch_deg, -60.0, 1e-9);
  EXPECT_NEAR(back.yaw_deg, -120.0, 1e-9);
}

TEST(SensorMounting, StraightUpIsARotationStill) {
  SensorMounting back = turned(1.0, 2.0, 3.0);
  back.setRotation(rotation(30.0, 90.0, 50.0));
  EXPECT_TRUE(back.T_base_sensor().linear().isApprox(rotation(30.0, 90.0, 50.0), 1e-6));
}

TEST(SensorMounting, OpticalAxesOfALevelCamera) {
  SensorMounting camera;
  camera.z_m = 0.283;
  const Eigen::Isometry3d T = camera.T_base_optical();
  EXPECT_TRUE((T * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(1, 0, 0.283)));   // ahead
  EXPECT_TRUE((T * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0, -1, 0.283)));  // to the right
  EXPECT_TRUE((T * Eigen::Vector3d(0, 1, 0)).isApprox(Eigen::Vector3d(0, 0, -0.717)));  // down
}

TEST(SensorMounting, AnglesTurnAboutFixedAxesRollFirst) {
  const Eigen::Matrix3d R = rotation(90.0, 0.0, 90.0);
  // y goes up by the roll and stays there; x goes to the left by the yaw.
  EXPECT_TRUE((R * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
  EXPECT_TRUE((R * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
}

TEST(RigFile, TheCameraLooksAlongXUnlessItIsTurned) {
  const Eigen::Matrix3d R_base_camera =
      RigFile::parse(kRig, "rig.yaml").mounting().camera.T_base_optical().linear();
  // 10 degrees of pitch lower the view.
  const Eigen::Vector3d view = R_base_camera * Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(view.isApprox(Eigen::Vector3d(std::cos(M_PI / 18), 0.0, -std::sin(M_PI / 18)), 1e-9));
  EXPECT_TRUE((R_base_camera * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitY(), 1e-9));
}

TEST(RigFile, TheOneInThePackageIsValidAndKeepsTheThesisMounting) {
  const std::string path = std::string(STEREO_NAV_SOURCE_DIR) + "/config/rigs/thesis.yaml";
  EXPECT_EQ(RigFile::load(path).mounting().camera.z_m, 0.283);
}

TEST(RigFile, OnlyTheThreeNumbersChange) {
  RigFile rig = RigFile::parse(kRig, "rig.yaml");
  const RigFile untouched = rig;
  rig.setRotation("imu", rotation(-1.234, -0.001, 89.996));
  std::string expected = kRig;
  const std::string before = "z_m: 0.1, roll_deg: 0.0, pitch_deg: 0.0, yaw_deg: 0}";
  expected.replace(expected.find(before), before.size(),
                   "z_m: 0.1, roll_deg: -1.23, pitch_deg: 0.00, yaw_deg: 90.00}");
  EXPECT_EQ(rig.text(), expected);
  EXPECT_EQ(rig.mounting().imu.yaw_deg, 90.0);
  EXPECT_EQ(untouched.mounting().imu.yaw_deg, 0.0) << "a copy is of its own";
}

TEST(RigFile, BlockStyleAndAnyOrderAreFine) {
  const std::string block =
      "mounting:\r\n  imu:\r\n    yaw_deg: 1 # measured\r\n    roll_deg: 2\r\n    x_m: 0\r\n    pitch_deg: "
      "3.5e0\r\n";
  RigFile rig = RigFile::parse(block, "rig.yaml");
  rig.setRotation("imu", rotation(10.0, 20.0, 30.0));
  EXPECT_EQ(rig.text(),
            "mounting:\r\n  imu:\r\n    yaw_deg: 30.00 # measured\r\n    roll_deg: 10.00\r\n    x_m: 0\r\n"
            "    pitch_deg: 20.00\r\n");
}

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

void expectRefusal(const std::string& text, const std::string& part) {
  const std::string message =
      messageOf([&] { RigFile::parse(text, "rig.yaml").setRotation("imu", Eigen::Matrix3d::Identity()); });
  EXPECT_EQ(message.rfind("rig.yaml: ", 0), 0u) << text << ": " << message;
  EXPECT_NE(message.find(part), std::string::npos) << text << ": " << message;
}

TEST(RigFile, WhatCannotBeReplacedIsNamed) {
  expectRefusal("", "this one holds none");
  expectRefusal("cameras: {}", "mounting/imu/roll_deg is missing");
  expectRefusal("mounting: {camera: {}}", "mounting/imu/roll_deg is missing");
  expectRefusal("mounting: {imu: {roll_deg: 0, yaw_deg: 0}}", "mounting/imu/pitch_deg is missing");
  expectRefusal("mounting: {imu: {roll_deg: left, pitch_deg: 0, yaw_deg: 0}}", "'left', no number");
  expectRefusal("mounting: {imu: {roll_deg: '0', pitch_deg: 0, yaw_deg: 0}}", "without quotes");
  expectRefusal("mounting: [", "not valid YAML");
  expectRefusal("mounting: {x: 1}\n[imu, laser]: 1", "line 2: expected is a name with a colon behind it");
  expectRefusal("mounting: &a {camera: [*a, *a]}", "does an alias hold itself?");
}

TEST(RigFile, NumbersAreReplacedInsertedAndAppended) {
  RigFile rig = RigFile::parse(
      "drive:  # ours\n  wheels: 2\n  wheel_1: {name: left, radius_m: 0.05}  # worn\n  wheel_2:\n    name: right\n",
      "rig.yaml");
  rig.setNumber({"drive", "wheel_1", "radius_m"}, "0.049");
  rig.setNumber({"drive", "wheel_1", "y_m"}, "0.2");
  rig.setNumber({"drive", "wheel_2", "y_m"}, "-0.2");
  rig.setNumber({"wheel_odometry", "scale_sigma"}, "0.001");
  rig.setNumber({"wheel_odometry", "pulse_sigma"}, "0.3");
  EXPECT_EQ(
      rig.text(),
      "drive:  # ours\n  wheels: 2\n  wheel_1: {y_m: 0.2, name: left, radius_m: 0.049}  # worn\n  wheel_2:\n"
      "    y_m: -0.2\n    name: right\n"
      "wheel_odometry:\n  pulse_sigma: 0.3\n  scale_sigma: 0.001\n");
  EXPECT_EQ(rig.section("drive")["wheel_2"]["y_m"].as<double>(), -0.2);
  EXPECT_NE(messageOf([&] {
              rig.setNumber({"drive", "wheel_3", "y_m"}, "0");
            }).find("drive/wheel_3/y_m cannot be set: drive/wheel_3 is missing"),
            std::string::npos);
}

TEST(RigFile, UnknownSectionsAndNamesAreRefused) {
  EXPECT_EQ(messageOf([] { RigFile::parse("camera: {}", "rig.yaml"); }),
            "rig.yaml: unknown section camera; a rig has: cameras | imu | laser | range_finders | mounting | "
            "disparity | drive | wheel_odometry | uncertainty | base");
  EXPECT_NE(messageOf([] {
              RigFile::parse("mounting: {lidar: {}}", "rig.yaml").mounting();
            }).find("rig.yaml: mounting: unknown parameter lidar"),
            std::string::npos);
  EXPECT_NE(messageOf([] { RigFile::load("/no/such/rig.yaml"); }).find("cannot be read"), std::string::npos);
}

TEST(RigFile, WhatIsLeftOutIsEmptyOrZero) {
  const RigFile rig = RigFile::parse("imu: {port: /dev/ttyUSB1}", "rig.yaml");
  EXPECT_TRUE(rig.section(rig_sections::kDisparity).IsNull());
  EXPECT_EQ(rig.section(rig_sections::kImu)["port"].as<std::string>(), "/dev/ttyUSB1");
  EXPECT_TRUE(rig.mounting().camera.T_base_sensor().isApprox(Eigen::Isometry3d::Identity()));
}

}  // namespace
}  // namespace stereo_nav
