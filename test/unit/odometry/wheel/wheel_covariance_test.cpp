#include <gtest/gtest.h>

#include "kinematics/layouts.h"
#include "unit/odometry/wheel/driven_wheels.h"

namespace stereo_nav::odometry {
namespace {

using namespace kinematics;

constexpr int kRuns = 1000;

/// A run of 5 s, in the middle of it a rest, with errors drawn as the parameters say; the normalised squared
/// error of its end.
double squaredErrorOfARun(const WheelOdometryParams& params, bool with_yaw, int rest, std::mt19937& random) {
  std::normal_distribution<double> normal;
  DriveParams true_drive = params.drive;
  for (auto& wheel : true_drive.wheels) wheel.radius_m *= 1.0 + params.scale_sigma * normal(random);
  DrivenWheels base(true_drive);
  const double drift_rad_per_s = params.yaw_drift_sigma_rad_per_s * normal(random);
  const double period_s = 0.02;
  double yaw_error_rad = 0.0;
  WheelOdometry odometry(params);
  WheelOdometryResult result = odometry.process(base.sample(with_yaw));
  for (int i = 0; i < 250 + rest; ++i) {
    const bool rests = i >= 100 && i < 100 + rest;
    const Twist twist = rests ? Twist::Zero() : twistAt(period_s * (i < 100 ? i : i - rest));
    std::vector<double> slip_m;
    for (const auto& wheel : base.drive().inverse(twist))
      slip_m.push_back(params.slip_sigma_m * std::sqrt(std::abs(wheel.speed_m_per_s) * period_s) *
                       normal(random));
    base.move(twist, period_s, slip_m);
    yaw_error_rad += drift_rad_per_s * period_s + params.yaw_sigma_rad * std::sqrt(period_s) * normal(random);
    WheelSample sample = base.sample(with_yaw);
    if (with_yaw) *sample.yaw_rad += yaw_error_rad;
    result = odometry.process(sample);
  }
  const Eigen::Vector3d error = logPlanar(result.T_odom_base.inverse() * base.pose());
  return error.dot(result.pose_covariance.inverse() * error);
}

/// Three degrees of freedom: 3 is expected. The mean of 1000 runs scatters by 0.08 (1 sigma), and the slip
/// that is raised by contradictions makes the covariance some per cent too large where there is redundancy.
void expectConsistent(const WheelOdometryParams& params, bool with_yaw, int rest = 0) {
  std::mt19937 random(7);
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) sum += squaredErrorOfARun(params, with_yaw, rest, random);
  EXPECT_GT(sum / kRuns, 2.7);
  EXPECT_LT(sum / kRuns, 3.3);
}

TEST(WheelCovariance, consistentForThreeOmniWheels) {
  expectConsistent(odometryOf(omniDrive(3, 0.195, 60.0, 0.051)), false);
}

TEST(WheelCovariance, consistentWithTheYawOfAnImu) {
  expectConsistent(odometryOf(omniDrive(3, 0.195, 60.0, 0.051)), true);
}

TEST(WheelCovariance, consistentWhenTheDriftOfTheYawIsMeasuredAtRest) {
  WheelOdometryParams params = odometryOf(omniDrive(3, 0.195, 60.0, 0.051));
  params.yaw_drift_sigma_rad_per_s = 0.003;  // most of the error of the yaw
  expectConsistent(params, true, 150);
}

TEST(WheelCovariance, readingsDoNotAddUp) {
  WheelOdometryParams params = odometryOf(differentialDrive(0.4, 0.05));
  params.slip_sigma_m = 0.0;
  params.scale_sigma = 0.0;
  params.pulse_sigma = 1.0;
  WheelOdometry odometry(params);
  DrivenWheels base(params.drive);
  WheelOdometryResult result = odometry.process(base.sample(false));
  for (int i = 0; i < 1000; ++i) {
    base.move({0.5, 0.0, 0.0}, 0.02);
    result = odometry.process(base.sample(false));
  }
  // Mean of two wheels, difference of two readings.
  const double pulse_m = params.drive.wheels[0].metresPerPulse();
  EXPECT_NEAR(result.pose_covariance(0, 0), pulse_m * pulse_m, 0.01 * pulse_m * pulse_m);
}

}  // namespace
}  // namespace stereo_nav::odometry
