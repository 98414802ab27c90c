#include "odometry/wheel/encoder_check.h"

#include <gtest/gtest.h>

#include <functional>

#include "kinematics/layouts.h"
#include "unit/odometry/wheel/driven_wheels.h"

namespace stereo_nav::odometry {
namespace {

using namespace kinematics;
using Fault = std::function<void(std::vector<std::int64_t>&)>;

/// What the odometry says after 20 s with a fault in the pulses.
std::string problemWith(const DriveParams& drive, bool with_yaw, const Fault& fault) {
  WheelOdometry odometry(odometryOf(drive));
  DrivenWheels base(drive);
  std::string problem;
  for (int i = 0; i < 1000; ++i) {
    base.move(twistAt(0.02 * i), 0.02);
    WheelSample sample = base.sample(with_yaw);
    fault(sample.pulses);
    problem = odometry.process(sample).problem;
  }
  return problem;
}

void expectFound(const DriveParams& drive, bool with_yaw) {
  const auto problem = [&](const Fault& fault) { return problemWith(drive, with_yaw, fault); };
  EXPECT_EQ(problem([](auto&) {}), "");
  const std::string backwards = problem([](auto& pulses) { pulses[1] *= -1; });
  EXPECT_NE(backwards.find("wheel_2 (" + drive.wheels[1].name + ") counts backwards"), std::string::npos)
      << backwards;
  const std::string dead = problem([](auto& pulses) { pulses[0] = 0; });
  EXPECT_NE(dead.find("wheel_1 (" + drive.wheels[0].name + ") gives no pulses"), std::string::npos) << dead;
}

TEST(EncoderCheck, fourMecanumWheels) {
  expectFound(mecanumDrive(0.15, 0.12, 0.05), false);
  expectFound(mecanumDrive(0.15, 0.12, 0.05), true);
}

TEST(EncoderCheck, threeOmniWheelsAndAnImu) {
  expectFound(omniDrive(3, 0.195, 60.0, 0.051), true);
}

TEST(EncoderCheck, deadWheelsAndAnImu) {
  expectFound(deadWheels(0.5377, 0.2745, 0.0296), true);
}

TEST(EncoderCheck, swappedEncoders) {
  const std::string mecanum = problemWith(mecanumDrive(0.15, 0.12, 0.05), true,
                                          [](auto& pulses) { std::swap(pulses[0], pulses[1]); });
  EXPECT_NE(mecanum.find("wheel_1 (front_left) and wheel_2 (front_right) are swapped"), std::string::npos)
      << mecanum;
  const auto swapped = [](auto& pulses) { std::swap(pulses[0], pulses[2]); };
  const DriveParams modules = swerveDrive({{0.2, 0.15}, {0.2, -0.15}, {-0.2, 0.15}, {-0.2, -0.15}}, 0.05);
  EXPECT_EQ(problemWith(modules, false, [](auto&) {}), "");
  const std::string swerve = problemWith(modules, false, swapped);
  EXPECT_NE(swerve.find("wheel_1 (module_1) and wheel_3 (module_3) are swapped"), std::string::npos)
      << swerve;
}

TEST(EncoderCheck, wrongRadiiAreNoFaultOfAnEncoder) {
  DriveParams wrong = mecanumDrive(0.15, 0.12, 0.05);
  const DriveParams right = wrong;
  wrong.wheels[0].radius_m *= 1.05;
  wrong.wheels[1].radius_m *= 0.95;
  WheelOdometry odometry(odometryOf(wrong));
  DrivenWheels base(right);
  for (int i = 0; i < 1000; ++i) {
    base.move(twistAt(0.02 * i), 0.02);
    ASSERT_EQ(odometry.process(base.sample(true)).problem, "");
  }
}

}  // namespace
}  // namespace stereo_nav::odometry
