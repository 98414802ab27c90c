#include "sensors/imu/module_angles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angles.h"
#include "sensors/imu/angular_rate.h"

namespace stereo_nav::imu {
namespace {

TEST(ModuleAngles, GivesTheWorkedExampleOfTheThesis) {
  const Eigen::Quaterniond q = orientationFromModule({30.0, 10.0, -5.0});
  EXPECT_NEAR(q.x(), -0.0645, 5e-5);
  EXPECT_NEAR(q.y(), -0.0729, 5e-5);
  EXPECT_NEAR(q.z(), -0.2613, 5e-5);
  EXPECT_NEAR(q.w(), 0.9604, 5e-5);
}

TEST(ModuleAngles, APositiveModuleYawTurnsRight) {
  EXPECT_NEAR(heading(orientationFromModule({90.0, 0.0, 0.0})), -M_PI / 2, 1e-12);
}

TEST(ModuleAngles, ConvertsBackAndForth) {
  for (const double yaw : {-179.9, -60.0, 0.0, 33.3, 179.9}) {
    for (const double pitch : {-80.0, 0.0, 45.0}) {
      for (const double roll : {-170.0, 0.0, 20.0}) {
        const ModuleAngles back = moduleFromOrientation(orientationFromModule({yaw, pitch, roll}));
        EXPECT_NEAR(back.yaw_deg, yaw, 1e-9);
        EXPECT_NEAR(back.pitch_deg, pitch, 1e-9);
        EXPECT_NEAR(back.roll_deg, roll, 1e-9);
      }
    }
  }
}

TEST(ModuleAngles, StraightUpKeepsTheAttitude) {
  const Eigen::Quaterniond q = orientationFromModule({20.0, 90.0, 7.0});
  EXPECT_LT(q.angularDistance(orientationFromModule(moduleFromOrientation(q))), 1e-6);
}

TEST(ModuleAngles, WrapsTheShortWayRound) {
  EXPECT_DOUBLE_EQ(wrapDegrees(190.0), -170.0);
  EXPECT_DOUBLE_EQ(wrapDegrees(-359.0), 1.0);
}

TEST(AngularRate, IsThatOfASteadyTurnAcrossTheYawWrap) {
  AngularRate rate(0.02);
  for (int i = 0; i < 200; ++i) {
    const double t = 0.01 * i;
    const auto omega = rate.update(t, orientationFromModule({wrapDegrees(170.0 + 20.0 * t), 0.0, 0.0}));
    ASSERT_EQ(omega.has_value(), i > 0);
    const Eigen::Vector3d expected(0, 0, -20.0 * M_PI / 180.0);
    EXPECT_LT((omega.value_or(expected) - expected).norm(), 1e-6);
  }
}

TEST(AngularRate, IsInTheImuFrame) {
  AngularRate rate(0.02);
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()));
  const Eigen::Vector3d body_rate(0.3, -0.2, 0.4);
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();
  for (int i = 0; i < 10; ++i) {
    const double t = 0.01 * i;
    const Eigen::Quaterniond q = tilt * Eigen::AngleAxisd(body_rate.norm() * t, body_rate.normalized());
    omega = rate.update(t, q).value_or(omega);
  }
  EXPECT_LT((omega - body_rate).norm(), 1e-6);
}

TEST(AngularRate, BeginsAnewAfterAGap) {
  AngularRate rate(0.02);
  rate.update(0.0, Eigen::Quaterniond::Identity());
  EXPECT_FALSE(rate.update(1.0, orientationFromModule({50.0, 0.0, 0.0})).has_value());
}

}  // namespace
}  // namespace stereo_nav::imu
