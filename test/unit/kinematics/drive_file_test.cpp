#include "kinematics/drive_file.h"

#include <gtest/gtest.h>

#include "kinematics/layouts.h"

namespace stereo_nav::kinematics {
namespace {

std::string refusalOf(const std::string& text) {
  try {
    readDrive(RigFile::parse(text, "rig.yaml"));
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "nothing was refused";
}

void expectRefused(const std::string& text, const std::string& part) {
  const std::string message = refusalOf(text);
  EXPECT_EQ(message.rfind("rig.yaml: drive", 0), 0u) << message;
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(DriveFile, everyDriveIsWrittenAndReadBack) {
  DriveParams mecanum = mecanumDrive(0.15, 0.12, 0.05);
  mecanum.wheels[2].encoder_reversed = true;
  for (const DriveParams& drive :
       {mecanum, omniDrive(3, 0.195, 60.0, 0.051), differentialDrive(0.4, 0.05),
        ackermannDrive(0.5, 0.4, 35.0, 0.05), deadWheels(0.5377, 0.2745, 0.0296028),
        swerveDrive({{0.2, 0.2}, {0.2, -0.2}, {-0.2, 0.0}}, 0.05)}) {
    const DriveParams read = readDrive(RigFile::parse(driveSection(drive), "rig.yaml"));
    ASSERT_EQ(read.wheels.size(), drive.wheels.size());
    for (std::size_t i = 0; i < drive.wheels.size(); ++i) {
      EXPECT_EQ(read.wheels[i].name, drive.wheels[i].name);
      EXPECT_EQ(read.wheels[i].kind, drive.wheels[i].kind);
      EXPECT_EQ(read.wheels[i].roller_deg, drive.wheels[i].roller_deg);
      EXPECT_EQ(read.wheels[i].max_steering_deg, drive.wheels[i].max_steering_deg);
      EXPECT_NEAR(read.wheels[i].x_m, drive.wheels[i].x_m, 1e-6);
      EXPECT_NEAR(read.wheels[i].y_m, drive.wheels[i].y_m, 1e-6);
      EXPECT_NEAR(read.wheels[i].direction_deg, drive.wheels[i].direction_deg, 1e-4);
      EXPECT_NEAR(read.wheels[i].metresPerPulse(), drive.wheels[i].metresPerPulse(), 1e-9);
    }
  }
}

TEST(DriveFile, aCalibrationChangesTheGeometryAlone) {
  const std::string before =
      "drive:\n  wheels: 2\n"
      "  wheel_1: {name: left, kind: fixed, x_m: 0, y_m: 0.2, direction_deg: 0, radius_m: 0.05, pulses_per_turn: 1024} # worn\n"
      "  wheel_2: {name: right, kind: fixed, x_m: 0, y_m: -0.2, direction_deg: 0, radius_m: 0.05, pulses_per_turn: 1024}\n";
  RigFile rig = RigFile::parse(before, "rig.yaml");
  DriveParams drive = readDrive(rig);
  drive.wheels[0].radius_m = 0.0512345;
  drive.wheels[1].y_m = -0.21;
  writeDrive(drive, rig);
  EXPECT_EQ(
      rig.text(),
      "drive:\n  wheels: 2\n"
      "  wheel_1: {name: left, kind: fixed, x_m: 0.000000, y_m: 0.200000, direction_deg: 0.0000, radius_m: "
      "0.0512345, pulses_per_turn: 1024} # worn\n"
      "  wheel_2: {name: right, kind: fixed, x_m: 0.000000, y_m: -0.210000, direction_deg: 0.0000, radius_m: "
      "0.0500000, pulses_per_turn: 1024}\n");
}

TEST(DriveFile, whatIsMissingOrWrongIsNamed) {
  const std::string wheel = "{name: a, kind: fixed, y_m: 0.2, radius_m: 0.05, pulses_per_turn: 1024}";
  expectRefused("imu: {}", "is missing, so that nothing tells where the wheels are");
  expectRefused("drive: {}", "has no wheels");
  expectRefused("drive: {wheels: 2, wheel_1: " + wheel + "}", "drive.wheel_2 is missing, but `wheels` is 2");
  expectRefused("drive: {wheels: 1, wheel_1: " + wheel + ", wheel_2: " + wheel + "}",
                "unknown parameter wheel_2");
  expectRefused("drive: {wheels: 2, wheel_1: " + wheel + ", wheel_2: " + wheel + "}", "the name 'a'");
  expectRefused("drive: {wheels: 1, wheel_1: {radius_m: 0.05}}", "drive.wheel_1.pulses_per_turn is missing");
  expectRefused("drive: {wheels: 1, wheel_1: {pulses_per_turn: 9}}", "drive.wheel_1.radius_m is missing");
  expectRefused("drive: {wheels: 1, wheel_1: {radius_m: -1, pulses_per_turn: 9}}", "wheel_1.radius_m is -1");
  expectRefused("drive: {wheels: 1, wheel_1: " + wheel + "}", "do not determine the motion");
  expectRefused("drive: {wheels: many}", "must be a whole number");
}

}  // namespace
}  // namespace stereo_nav::kinematics
