#include "odometry/wheel/wheel_odometry.h"

#include <gtest/gtest.h>

#include "core/angles.h"
#include "kinematics/layouts.h"
#include "stereo_nav/core/input_error.h"
#include "unit/odometry/wheel/driven_wheels.h"

namespace stereo_nav::odometry {
namespace {

using namespace kinematics;

/// The dead wheels of the swerve robot of 2024: 0.2325 mm a pulse.
DriveParams publishedDeadWheels() {
  DriveParams drive = deadWheels(0.5377, 0.2745, 0.0296028);
  for (auto& wheel : drive.wheels) wheel.pulses_per_turn = 800.0;
  return drive;
}

/// Largest error of the position on 10 m straight at 1 m/s while spinning at 180 deg/s, in mm.
double worstWhileSpinning(double period_s, bool as_published) {
  WheelOdometryParams params = odometryOf(publishedDeadWheels());
  params.as_published = as_published;
  WheelOdometry odometry(params);
  DrivenWheels base(params.drive);
  odometry.process(base.sample(true));
  double worst_mm = 0.0;
  for (int i = 0; i < std::lround(10.0 / period_s); ++i) {
    base.moveStraightTurning(1.0, kPi, period_s);
    const auto result = odometry.process(base.sample(true));
    worst_mm =
        std::max(worst_mm, 1e3 * (result.T_odom_base.translation() - base.pose().translation()).norm());
  }
  return worst_mm;
}

TEST(WheelOdometry, straightWhileSpinning) {
  EXPECT_LT(worstWhileSpinning(0.010, false), 2.0);
  EXPECT_LT(worstWhileSpinning(0.020, false), 4.0);
  EXPECT_LT(worstWhileSpinning(0.050, false), 22.0);
}

TEST(WheelOdometry, asPublishedIsOffByHalfTheTurnOfAnInterval) {
  EXPECT_NEAR(worstWhileSpinning(0.010, true), 157.0, 3.0);
  EXPECT_NEAR(worstWhileSpinning(0.020, true), 314.0, 3.0);
  EXPECT_NEAR(worstWhileSpinning(0.050, true), 785.0, 8.0);
}

TEST(WheelOdometry, followsEveryDrive) {
  const std::vector<std::pair<std::string, DriveParams>> drives = {
      {"swerve", swerveDrive({{0.2, 0.2}, {0.2, -0.2}, {-0.2, 0.2}, {-0.2, -0.2}}, 0.05)},
      {"mecanum", mecanumDrive(0.15, 0.12, 0.05)},
      {"omni", omniDrive(3, 0.195, 60.0, 0.051)},
      {"differential", differentialDrive(0.4, 0.05)},
      {"ackermann", ackermannDrive(0.5, 0.4, 35.0, 0.05)},
      {"dead wheels", publishedDeadWheels()}};
  for (auto [name, drive] : drives) {
    for (auto& wheel : drive.wheels) wheel.pulses_per_turn = 1e5;
    WheelOdometry odometry(odometryOf(drive));
    DrivenWheels base(drive);
    WheelOdometryResult result = odometry.process(base.sample(false));
    const Twist twist(0.5, name == "differential" || name == "ackermann" ? 0.0 : 0.2, 0.4);
    // The first interval turns the steered wheels, the others keep them.
    base.move(twist * 1e-6, 1e-6);
    odometry.process(base.sample(false));
    for (int i = 0; i < 500; ++i) {
      base.move(twist, 0.02);
      result = odometry.process(base.sample(false));
    }
    EXPECT_LT(logPlanar(result.T_odom_base.inverse() * base.pose()).norm(), 1e-3) << name;
    EXPECT_LT((result.twist - twist).norm(), 1e-3) << name;
    EXPECT_EQ(result.problem, "") << name;
  }
}

TEST(WheelOdometry, countersWrap) {
  WheelOdometryParams params = odometryOf(publishedDeadWheels());
  WheelOdometry wide(params);
  params.counter_bits = 16;
  WheelOdometry narrow(params);
  DrivenWheels base(params.drive);
  for (int i = 0; i < 4000; ++i) {
    base.move(i < 2500 ? Twist(1.5, 0.0, 0.0) : Twist(-1.5, 0.2, 0.1), 0.02);
    WheelSample sample = base.sample(true);
    const auto expected = wide.process(sample);
    for (auto& pulses : sample.pulses) pulses = static_cast<std::int16_t>(pulses);
    ASSERT_TRUE(narrow.process(sample).T_odom_base.isApprox(expected.T_odom_base, 1e-12)) << i;
  }
}

TEST(WheelOdometry, yawOfTheImuOverrulesWheelsThatSlip) {
  const DriveParams drive = differentialDrive(0.4, 0.05);
  WheelOdometry odometry(odometryOf(drive));
  DrivenWheels base(drive);
  WheelOdometryResult result = odometry.process(base.sample(true));
  for (int i = 0; i < 100; ++i) {
    base.move({0.5, 0.0, 0.0}, 0.02, {0.0, i < 50 ? 0.0 : 0.002});
    result = odometry.process(base.sample(true));
    if (i == 49) {
      EXPECT_LT(result.slip, 1.5);
    }
  }
  EXPECT_LT(std::abs(logPlanar(result.T_odom_base).z()), 0.01);  // by its wheels alone 0.25 rad
  EXPECT_GT(result.slip, 2.0);
}

TEST(WheelOdometry, setPoseKeepsTheSpeed) {
  const DriveParams drive = publishedDeadWheels();
  WheelOdometry odometry(odometryOf(drive));
  DrivenWheels base(drive);
  for (int i = 0; i < 20; ++i) {
    base.move({1.0, 0.0, 0.5}, 0.02);
    odometry.process(base.sample(true));
  }
  const Eigen::Isometry2d T = expPlanar({3.0, -2.0, 1.0});
  odometry.setPose(T, Eigen::Vector3d(0.01, 0.01, 0.02).asDiagonal());
  base.move({1.0, 0.0, 0.5}, 0.02);
  const auto result = odometry.process(base.sample(true));
  EXPECT_LT((T.inverse() * result.T_odom_base).translation().norm(), 0.0215);
  EXPECT_LT((result.twist - Twist(1.0, 0.0, 0.5)).norm(), 0.02);
  EXPECT_NEAR(result.pose_covariance(2, 2), 0.02, 1e-3);
}

TEST(WheelOdometry, refusesWhatIsNoSampleOfThisDrive) {
  WheelOdometry odometry(odometryOf(publishedDeadWheels()));
  const auto messageFor = [&odometry](const WheelSample& sample) {
    try {
      odometry.process(sample);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(messageFor({1.0, {0, 0}, {}, {}}).find("2 pulse counters, the drive has 3 wheels"),
            std::string::npos);
  EXPECT_EQ(messageFor({1.0, {0, 0, 0}, {}, {}}), "");
  EXPECT_NE(messageFor({1.0, {0, 0, 0}, {}, {}}).find("not later than the last one"), std::string::npos);
  WheelOdometry swerve(odometryOf(swerveDrive({{0.2, 0.0}, {-0.2, 0.0}}, 0.05)));
  EXPECT_THROW(swerve.process({1.0, {0, 0}, {}, {}}), InputError);
}

}  // namespace
}  // namespace stereo_nav::odometry
