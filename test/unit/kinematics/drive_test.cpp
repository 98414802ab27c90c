#include "kinematics/drive.h"

#include <gtest/gtest.h>

#include "core/angles.h"
#include "kinematics/layouts.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::kinematics {
namespace {

/// Square of half side 12: front left, front right, rear left, rear right.
DriveParams square() {
  return swerveDrive({{12, 12}, {12, -12}, {-12, 12}, {-12, -12}}, 0.05);
}

void expectWheels(const std::vector<WheelState>& wheels, const std::vector<double>& speeds,
                  const std::vector<double>& angles_deg) {
  ASSERT_EQ(wheels.size(), speeds.size());
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    EXPECT_NEAR(wheels[i].speed_m_per_s, speeds[i], 1e-2) << i;
    if (!angles_deg.empty()) {
      EXPECT_NEAR(kDegPerRad * wheels[i].steering_rad, angles_deg[i], 1e-2) << i;
    }
  }
}

std::vector<std::pair<std::string, DriveParams>> holonomicDrives() {
  return {{"swerve", square()},
          {"swerve of two", swerveDrive({{0.2, 0.1}, {-0.2, -0.1}}, 0.05)},
          {"swerve of three", swerveDrive({{0.2, 0.0}, {-0.1, 0.2}, {-0.1, -0.2}}, 0.05)},
          {"mecanum", mecanumDrive(0.15, 0.12, 0.05)},
          {"omni of three", omniDrive(3, 0.195, 60.0, 0.051)},
          {"omni of four", omniDrive(4, 0.2, 45.0, 0.05)},
          {"omni of five", omniDrive(5, 0.2, 0.0, 0.05)},
          {"dead wheels", deadWheels(0.5377, 0.2745, 0.0296028)}};
}

TEST(Drive, swerveTurnsInPlace) {
  const double speed = 106.63;
  expectWheels(Drive(square()).inverse({0.0, 0.0, 2.0 * kPi}), {speed, speed, speed, speed},
               {135, 45, -135, -45});
}

TEST(Drive, swerveTurnsAboutItsCorner) {
  expectWheels(Drive(square()).inverse(aboutPoint({0.0, 0.0, 2.0 * kPi}, {12, 12})),
               {0.0, 150.796, 150.796, 213.258}, {0.0, 0.0, -90.0, -45.0});
}

TEST(Drive, swerveMovesAboutAPointAhead) {
  expectWheels(Drive(square()).inverse(aboutPoint({0.0, 3.0, 1.5}, {24, 0})), {23.43, 23.43, 54.08, 54.08},
               {-140.19, -39.81, -109.44, -70.56});
}

TEST(Drive, mecanumIsThePublishedFormula) {
  const double lx = 0.15, ly = 0.12;
  const Drive drive(mecanumDrive(lx, ly, 0.05));
  const Twist twist(0.3, -0.2, 0.7);
  const auto wheels = drive.inverse(twist);
  const double a[] = {-1, 1, 1, -1}, b[] = {-1, 1, -1, 1};
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(wheels[i].speed_m_per_s, twist.x() + a[i] * twist.y() + b[i] * (lx + ly) * twist.z(), 1e-12)
        << i;
}

TEST(Drive, mecanumForwardIsThePublishedFormula) {
  const double lx = 0.15, ly = 0.12, w[] = {0.9, 0.4, 0.7, 0.3};
  const ForwardResult result =
      Drive(mecanumDrive(lx, ly, 0.05)).forward({{w[0], 0.0}, {w[1], 0.0}, {w[2], 0.0}, {w[3], 0.0}});
  EXPECT_NEAR(result.twist.x(), (w[0] + w[1] + w[2] + w[3]) / 4.0, 1e-12);
  EXPECT_NEAR(result.twist.y(), (-w[0] + w[1] + w[2] - w[3]) / 4.0, 1e-12);
  EXPECT_NEAR(result.twist.z(), (-w[0] + w[1] - w[2] + w[3]) / (4.0 * (lx + ly)), 1e-12);
}

/// dx = (L + R) / 2, dth = (R - L) / trackwidth, dy = C - (R - L) forward_offset / trackwidth.
TEST(Drive, deadWheelsAreThePublishedFormula) {
  const double width = 0.5377, offset = 0.2745, left = 0.31, right = 0.42, across = 0.17;
  DriveParams params = deadWheels(width, offset, 0.0296028);
  const Twist twist = Drive(params).forward({{left, 0.0}, {right, 0.0}, {across, 0.0}}).twist;
  EXPECT_NEAR(twist.x(), (left + right) / 2.0, 1e-12);
  EXPECT_NEAR(twist.y(), across - (right - left) * offset / width, 1e-12);
  EXPECT_NEAR(twist.z(), (right - left) / width, 1e-12);
  params.wheels[0].pulses_per_turn = 800.0;
  EXPECT_NEAR(1e3 * params.wheels[0].metresPerPulse(), 0.2325, 1e-4) << "mm a pulse";
}

TEST(Drive, forwardAfterInverse) {
  for (const auto& [name, params] : holonomicDrives()) {
    const Drive drive(params);
    for (const Twist& twist :
         {Twist(1.0, 0.0, 0.0), Twist(0.0, 1.0, 0.0), Twist(0.0, 0.0, 1.0), Twist(0.3, -0.7, 2.0)}) {
      const ForwardResult result = drive.forward(drive.inverse(twist));
      EXPECT_LT((result.twist - twist).norm(), 1e-9) << name;
      EXPECT_LT(result.slip_m_per_s, 1e-9) << name;
    }
  }
}

TEST(Drive, forwardAfterInverseOfDrivesThatCannotMoveSideways) {
  for (const auto& params : {differentialDrive(0.4, 0.05), ackermannDrive(0.5, 0.4, 35.0, 0.05)}) {
    const Drive drive(params);
    for (const Twist& twist : {Twist(1.0, 0.3, 0.5), Twist(-1.0, 0.0, 0.4)}) {
      const ForwardResult result = drive.forward(drive.inverse(twist));
      EXPECT_LT((result.twist - Twist(twist.x(), 0.0, twist.z())).norm(), 1e-9);
      EXPECT_LT(result.slip_m_per_s, 1e-9);
    }
  }
}

TEST(Drive, ackermannSteersAroundOnePointAndWithinItsLimit) {
  const Drive drive(ackermannDrive(0.5, 0.4, 30.0, 0.05));
  const auto wheels = drive.inverse({1.0, 0.0, 0.5});  // circle of 2 m
  EXPECT_NEAR(wheels[0].steering_rad, std::atan(0.5 / 1.8), 1e-12);
  EXPECT_NEAR(wheels[1].steering_rad, std::atan(0.5 / 2.2), 1e-12);
  for (const double speed : {1.0, -1.0}) {
    for (const double turn : {9.0, -9.0}) {
      const Twist possible = drive.nearestPossible({speed, 0.0, turn});
      EXPECT_NEAR(speed / possible.z(),
                  speed * turn > 0.0 ? 0.5 / std::tan(kPi / 6.0) + 0.2 : -(0.5 / std::tan(kPi / 6.0) + 0.2),
                  1e-9);
      for (const auto& wheel : drive.inverse({speed, 0.0, turn}))
        EXPECT_LE(std::abs(wheel.steering_rad), kPi / 6.0 + 1e-9);
    }
  }
  EXPECT_NEAR(drive.nearestPossible({0.0, 0.0, 1.0}).z(), 0.0, 1e-12);
}

TEST(Drive, contradictionsAreSlip) {
  const Drive drive(mecanumDrive(0.15, 0.12, 0.05));
  auto wheels = drive.inverse({0.5, 0.0, 0.0});
  wheels[2].speed_m_per_s += 0.1;
  EXPECT_NEAR(drive.forward(wheels).slip_m_per_s, 0.05,
              1e-12);  // a quarter of the square is left, one equation
}

TEST(Drive, namesTheMotionThatNoWheelSees) {
  try {
    Drive drive(omniDrive(2, 0.2, 0.0, 0.05));
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_NE(std::string(error.what()).find("do not determine the motion"), std::string::npos)
        << error.what();
  }
}

TEST(DriveParams, anyNumberOfWheelsFromYaml) {
  DriveParams params;
  readParameters(
      YAML::Load("{wheels: 2, wheel_1: {name: left, kind: fixed, y_m: 0.2}, wheel_2: {name: right, kind: "
                 "fixed, y_m: -0.2, radius_m: 0.06}}"),
      "rig.yaml: drive", params);
  ASSERT_EQ(params.wheels.size(), 2u);
  EXPECT_EQ(params.wheels[1].name, "right");
  EXPECT_EQ(params.wheels[1].radius_m, 0.06);
  EXPECT_EQ(params.wheels[0].kind, WheelKind::kFixed);
  EXPECT_THROW(readParameters(YAML::Load("{wheels: 1, wheel_2: {}}"), "rig.yaml", params), ParameterError);
}

TEST(Drive, anAxleThatWasMeasuredTurnsAllTheSame) {
  DriveParams params = differentialDrive(0.4, 0.05);
  params.wheels[0].x_m = 1e-3;
  params.wheels[1].direction_deg = 0.1;
  const Drive drive(params);
  EXPECT_LT((drive.nearestPossible({0.3, 0.0, 0.0}) - Twist(0.3, 0.0, 0.0)).norm(), 1e-3);
  EXPECT_LT((drive.nearestPossible({0.0, 0.0, 1.0}) - Twist(0.0, 0.0, 1.0)).norm(), 2e-3);
}

}  // namespace
}  // namespace stereo_nav::kinematics
