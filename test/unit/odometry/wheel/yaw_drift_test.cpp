#include "odometry/wheel/yaw_drift.h"

#include <gtest/gtest.h>

#include "core/angles.h"
#include "kinematics/layouts.h"
#include "unit/odometry/wheel/driven_wheels.h"

namespace stereo_nav::odometry {
namespace {

using namespace kinematics;

constexpr double kStep_s = 0.02;

/// A robot whose IMU drifts: base and odometry side by side.
class DriftingImu {
 public:
  DriftingImu(const DriveParams& drive, double drift_rad_per_s)
      : odometry_(odometryOf(drive)), base_(drive), drift_rad_per_s_(drift_rad_per_s) {}

  /// `by_hand` turns the base without its wheels.
  WheelOdometryResult move(const Twist& twist, double duration_s, double by_hand_rad_per_s = 0.0) {
    WheelOdometryResult result;
    for (int i = 0; i < std::lround(duration_s / kStep_s); ++i) {
      base_.move(twist, kStep_s);
      imu_error_rad_ += (drift_rad_per_s_ + by_hand_rad_per_s) * kStep_s;
      WheelSample sample = base_.sample(true);
      sample.yaw_rad = wrapRadians(*sample.yaw_rad + imu_error_rad_);
      result = odometry_.process(sample);
    }
    return result;
  }

  double trueYaw() const { return logPlanar(base_.pose()).z(); }

 private:
  WheelOdometry odometry_;
  DrivenWheels base_;
  double drift_rad_per_s_;
  double imu_error_rad_ = 0.0;
};

double yawOf(const WheelOdometryResult& result) {
  return logPlanar(result.T_odom_base).z();
}

std::vector<std::pair<std::string, DriveParams>> drives() {
  return {{"differential", differentialDrive(0.4, 0.05)},
          {"dead wheels", deadWheels(0.5377, 0.2745, 0.0296028)},
          {"swerve", swerveDrive({{0.2, 0.2}, {0.2, -0.2}, {-0.2, 0.2}, {-0.2, -0.2}}, 0.05)}};
}

TEST(YawDrift, aRobotAtRestDoesNotTurn) {
  for (const auto& [name, drive] : drives()) {
    DriftingImu robot(drive, 0.3 * kRadPerDeg);
    const double after_a_second = yawOf(robot.move(Twist::Zero(), 1.0));
    EXPECT_LT(std::abs(after_a_second), 0.3 * kRadPerDeg) << name;
    const auto result = robot.move(Twist::Zero(), 600.0);
    EXPECT_NEAR(yawOf(result), after_a_second, 1e-12) << name << ": it would be 180 deg";
    EXPECT_NEAR(result.yaw_drift_rad_per_s, 0.3 * kRadPerDeg, 1e-5) << name;
    EXPECT_LT(result.twist.norm(), 1e-12) << name;
  }
}

TEST(YawDrift, whatWasFoundAtRestIsTakenOffOnTheWay) {
  for (const auto& [name, drive] : drives()) {
    DriftingImu robot(drive, -0.3 * kRadPerDeg);
    const double before = yawOf(robot.move(Twist::Zero(), 10.0));
    const auto result = robot.move({0.3, 0.0, 0.0}, 60.0);
    EXPECT_NEAR(yawOf(result) - before, 0.0, 0.3 * kRadPerDeg) << name << ": without, 18 deg";
    EXPECT_LT(std::abs(yawOf(result) - before), 3.0 * std::sqrt(result.pose_covariance(2, 2))) << name;
  }
}

TEST(YawDrift, aBaseTurnedByHandTurns) {
  DriftingImu robot(differentialDrive(0.4, 0.05), 0.0);
  robot.move(Twist::Zero(), 5.0);
  EXPECT_NEAR(yawOf(robot.move(Twist::Zero(), 2.0, 0.5)), 1.0, 0.05);
  EXPECT_NEAR(robot.move(Twist::Zero(), 5.0).yaw_drift_rad_per_s, 0.0, 1e-6);
}

TEST(YawDrift, aSlowTurnBetweenPulsesIsNoRest) {
  const DriveParams drive = differentialDrive(0.4, 0.05);  // 0.3 mm a pulse
  DriftingImu robot(drive, 0.0);
  const auto result = robot.move({0.0, 0.0, 0.004}, 60.0);
  EXPECT_NEAR(yawOf(result), robot.trueYaw(), 0.005);
  EXPECT_NEAR(result.yaw_drift_rad_per_s, 0.0, 1e-9);
}

TEST(YawDrift, isKnownBetterAfterARest) {
  const DriveParams drive = differentialDrive(0.4, 0.05);
  DriftingImu rested(drive, 0.0), never(drive, 0.0);
  never.move({0.3, 0.0, 0.0}, 0.02);
  rested.move(Twist::Zero(), 60.0);
  const double sigma = std::sqrt(rested.move({0.3, 0.0, 0.0}, 100.0).pose_covariance(2, 2));
  EXPECT_LT(sigma, 0.5 * std::sqrt(never.move({0.3, 0.0, 0.0}, 100.0).pose_covariance(2, 2)));
}

}  // namespace
}  // namespace stereo_nav::odometry
