#include "sim/wheel_model.h"

#include <gtest/gtest.h>

#include "core/planar_motion.h"
#include "kinematics/layouts.h"
#include "odometry/wheel/wheel_odometry.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::sim {
namespace {

using kinematics::DriveParams;

Trajectory course(bool turns_on_the_spot) {
  PathStep ahead, aside, turn;
  ahead.x_m = 2.0;
  aside.x_m = 3.0;
  aside.y_m = 1.5;
  turn.action = PathStep::Action::kTurn;
  turn.angle_deg = 200.0;
  return {turns_on_the_spot ? std::vector<PathStep>{ahead, aside, turn} : std::vector<PathStep>{ahead, aside},
          MotionParams()};
}

/// Distance between where the odometry ends and where the base does.
double endError_m(const std::vector<SimulatedTicks>& ticks, const DriveParams& drive,
                  const Trajectory& trajectory) {
  odometry::WheelOdometryParams params;
  params.drive = drive;
  odometry::WheelOdometry odometry(params);
  odometry::WheelOdometryResult result;
  for (const auto& reading : ticks)
    result = odometry.process({reading.time_s, reading.pulses, reading.steering_rad, {}});
  const Eigen::Isometry2d T_start_end =
      planarPart(trajectory.pose(0.0)).inverse() * planarPart(trajectory.pose(result.time_s));
  return (result.T_odom_base.inverse() * T_start_end).translation().norm();
}

TEST(WheelModel, theOdometryOfTheTrueWheelsFollowsTheCourse) {
  for (DriveParams drive :
       {kinematics::swerveDrive({{0.2, 0.2}, {0.2, -0.2}, {-0.2, 0.2}, {-0.2, -0.2}}, 0.05),
        kinematics::mecanumDrive(0.15, 0.12, 0.05), kinematics::omniDrive(4, 0.2, 45.0, 0.05),
        kinematics::differentialDrive(0.4, 0.05), kinematics::deadWheels(0.5, 0.2, 0.03)}) {
    for (auto& wheel : drive.wheels) wheel.pulses_per_turn = 1e5;
    const Trajectory trajectory = course(true);
    EXPECT_LT(endError_m(simulateWheels({}, drive, trajectory, 1), drive, trajectory), 0.006);
  }
}

TEST(WheelModel, aCarCannotTurnOnTheSpot) {
  const DriveParams car = kinematics::ackermannDrive(0.3, 0.25, 60.0, 0.05);
  EXPECT_LT(endError_m(simulateWheels({}, car, course(false), 1), car, course(false)), 0.03);
  EXPECT_THROW(simulateWheels({}, car, course(true), 1), InputError);
}

TEST(WheelModel, radiiOtherThanTheNominalOnesAndSlipShow) {
  const DriveParams nominal = kinematics::differentialDrive(0.4, 0.05);
  WheelModelParams params;
  params.radius_sigma = 0.02;
  params.position_sigma_m = 0.005;
  const DriveParams truth = trueDrive(params, nominal, 4);
  EXPECT_EQ(trueDrive(params, nominal, 4).wheels[0].radius_m, truth.wheels[0].radius_m);
  EXPECT_NE(truth.wheels[0].radius_m, nominal.wheels[0].radius_m);
  EXPECT_NE(truth.wheels[0].radius_m / nominal.wheels[0].radius_m,
            truth.wheels[1].radius_m / nominal.wheels[1].radius_m);
  EXPECT_EQ(truth.wheels[0].x_m, 0.0);
  const Trajectory trajectory = course(true);
  const auto ticks = simulateWheels(params, truth, trajectory, 4);
  EXPECT_LT(endError_m(ticks, truth, trajectory), 0.005);
  EXPECT_GT(endError_m(ticks, nominal, trajectory), 0.02);
  params.slip_sigma_m = 0.02;
  EXPECT_GT(endError_m(simulateWheels(params, truth, trajectory, 4), truth, trajectory), 0.005);
}

}  // namespace
}  // namespace stereo_nav::sim
