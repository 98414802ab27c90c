#include "calibration/rig_mounting.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace stereo_nav::calibration {
namespace {

constexpr const char* kRig = R"(# Our robot. 20° of view are hidden by the arm.
capture: {left: /dev/video0}
mounting:            # poses in base_link
  camera: {x_m: 0.1, y_m: 0.06, z_m: 0.283, roll_deg: 0.0, pitch_deg: 10.0, yaw_deg: 0.0}  # ± 1°
  imu: {x_m: 0.0, y_m: 0.0, z_m: 0.1, roll_deg: 0.0, pitch_deg: 0.0, yaw_deg: 0}   # under the laptop
disparity: {range: 64}
)";

TEST(RigMounting, AnglesTurnIntoRotationsAndBack) {
  RollPitchYaw angles;
  angles.roll_deg = 170.0;
  angles.pitch_deg = -60.0;
  angles.yaw_deg = -120.0;
  const RollPitchYaw back = RollPitchYaw::of(angles.rotation());
  EXPECT_NEAR(back.roll_deg, 170.0, 1e-9);
  EXPECT_NEAR(back.pitch_deg, -60.0, 1e-9);
  EXPECT_NEAR(back.yaw_deg, -120.0, 1e-9);
}

TEST(RigMounting, StraightUpIsARotationStill) {
  RollPitchYaw angles;
  angles.roll_deg = 30.0;
  angles.pitch_deg = 90.0;
  angles.yaw_deg = 50.0;
  const RollPitchYaw back = RollPitchYaw::of(angles.rotation());
  EXPECT_TRUE(back.rotation().isApprox(angles.rotation(), 1e-6));
}

TEST(RigMounting, TheCameraLooksAlongXUnlessItIsTurned) {
  const Eigen::Matrix3d R_base_camera = readCameraRotation(kRig, "rig.yaml");
  // 10 degrees of pitch lower the view.
  const Eigen::Vector3d view = R_base_camera * Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(view.isApprox(Eigen::Vector3d(std::cos(M_PI / 18), 0.0, -std::sin(M_PI / 18)), 1e-9));
  EXPECT_TRUE((R_base_camera * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitY(), 1e-9));
}

TEST(RigMounting, OnlyTheThreeNumbersChange) {
  RollPitchYaw angles;
  angles.roll_deg = -1.234;
  angles.pitch_deg = -0.001;
  angles.yaw_deg = 89.996;
  std::string expected = kRig;
  const std::string before = "z_m: 0.1, roll_deg: 0.0, pitch_deg: 0.0, yaw_deg: 0}";
  expected.replace(expected.find(before), before.size(),
                   "z_m: 0.1, roll_deg: -1.23, pitch_deg: 0.00, yaw_deg: 90.00}");
  EXPECT_EQ(withImuRotation(kRig, "rig.yaml", angles.rotation()), expected);
}

TEST(RigMounting, BlockStyleAndAnyOrderAreFine) {
  const std::string block =
      "mounting:\r\n  imu:\r\n    yaw_deg: 1 # measured\r\n    roll_deg: 2\r\n    x_m: 0\r\n    pitch_deg: "
      "3.5e0\r\n";
  RollPitchYaw angles;
  angles.roll_deg = 10;
  angles.pitch_deg = 20;
  angles.yaw_deg = 30;
  EXPECT_EQ(withImuRotation(block, "rig.yaml", angles.rotation()),
            "mounting:\r\n  imu:\r\n    yaw_deg: 30.00 # measured\r\n    roll_deg: 10.00\r\n    x_m: 0\r\n"
            "    pitch_deg: 20.00\r\n");
}

void expectRefusal(const std::string& rig, const std::string& part) {
  try {
    withImuRotation(rig, "rig.yaml", Eigen::Matrix3d::Identity());
    FAIL() << "taken: " << rig;
  } catch (const RigFileError& error) {
    EXPECT_NE(std::string(error.what()).find("rig.yaml"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(RigMounting, WhatCannotBeReplacedIsNamed) {
  expectRefusal("", "mounting/imu/roll_deg is missing");
  expectRefusal("mounting: {camera: {}}", "mounting/imu/roll_deg is missing");
  expectRefusal("mounting: {imu: {roll_deg: 0, yaw_deg: 0}}", "mounting/imu/pitch_deg is missing");
  expectRefusal("mounting: {imu: {roll_deg: left, pitch_deg: 0, yaw_deg: 0}}", "'left', no number");
  expectRefusal("mounting: {imu: {roll_deg: '0', pitch_deg: 0, yaw_deg: 0}}", "without quotes");
  expectRefusal("mounting: [", "no YAML");
}

}  // namespace
}  // namespace stereo_nav::calibration
