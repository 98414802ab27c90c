#include <gtest/gtest.h>

#include <cmath>

#include "sensors/imu/emulation/emulated_module.h"
#include "sensors/imu/emulation/motion.h"

namespace stereo_nav::imu {
namespace {

TEST(Motion, RatesAndGravityFitTheAttitude) {
  const Motion turning = constantRates({0, 0, 0}, {-90.0, 0, 0});
  const MotionState state = turning(1.0);
  EXPECT_NEAR(heading(state.q_world_imu), M_PI / 2, 1e-9);
  EXPECT_NEAR(state.angular_velocity.z(), M_PI / 2, 1e-6);
  EXPECT_NEAR(state.linear_acceleration.z(), 9.80665, 1e-9);
}

TEST(Motion, ARecordedCurveFeelsItsCentrifugalForce) {
  // A circle of 2 m radius at 0.5 rad/s, counter-clockwise: 0.5 m/s^2 to the left.
  Trajectory circle;
  for (int k = 0; k < 1000; ++k) {
    const double angle = 0.5 * 0.01 * k;
    StampedPose pose;
    pose.time_s = 0.01 * k;
    pose.T_world_body.rotate(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
    pose.T_world_body.pretranslate(Eigen::Vector3d(2.0 * std::sin(angle), -2.0 * std::cos(angle), 0.0));
    circle.push_back(pose);
  }
  const MotionState state = recordedMotion(circle)(5.0);
  EXPECT_NEAR(state.angular_velocity.z(), 0.5, 1e-6);
  EXPECT_NEAR(state.linear_acceleration.x(), 0.0, 0.01);
  EXPECT_NEAR(state.linear_acceleration.y(), 0.5, 0.01);
}

TEST(EmulatedModule, DriftsLikeTheModuleOfTheThesis) {
  ModuleErrors errors;
  errors.yaw_drift_deg_s = 2.9 / 600.0;
  EmulatedModule module(Protocol::kAngles, AngleOrder::kYawPitchRoll, false, errors, 1);
  module.frame(constantRates({0, 0, 0}, {})(0.0), 600.0);
  EXPECT_NEAR(module.lastAngles().yaw_deg, 2.9, 1e-9);
}

}  // namespace
}  // namespace stereo_nav::imu
