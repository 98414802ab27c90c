#include "core/angles.h"

#include <gtest/gtest.h>

#include "core/optical_axes.h"
#include "core/roll_pitch_yaw.h"

namespace stereo_nav {
namespace {

TEST(Angles, WrapKeepsTheDirection) {
  EXPECT_DOUBLE_EQ(wrapDegrees(190.0), -170.0);
  EXPECT_DOUBLE_EQ(wrapDegrees(-359.0), 1.0);
  EXPECT_DOUBLE_EQ(wrapDegrees(720.0), 0.0);
  EXPECT_NEAR(wrapRadians(1.5 * kPi), -0.5 * kPi, 1e-15);
  EXPECT_NEAR(wrapRadians(-5.0), 2.0 * kPi - 5.0, 1e-15);
  EXPECT_DOUBLE_EQ(90.0 * kRadPerDeg, 0.5 * kPi);
  EXPECT_DOUBLE_EQ(kRadPerDeg * kDegPerRad, 1.0);
}

TEST(RollPitchYaw, TurnsAboutFixedAxesRollFirst) {
  // Roll by 90 degrees takes y to z; yaw by 90 degrees then leaves z where it is.
  const Eigen::Matrix3d R = RollPitchYaw::fromDegrees(90.0, 0.0, 90.0).rotation();
  EXPECT_TRUE((R * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
  EXPECT_TRUE((R * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  // A positive pitch makes x look down.
  EXPECT_NEAR((RollPitchYaw{0.0, 0.1, 0.0}.rotation() * Eigen::Vector3d::UnitX()).z(), -std::sin(0.1), 1e-12);
}

TEST(RollPitchYaw, ComesBackFromTheMatrix) {
  for (const double pitch : {-1.5, -0.3, 0.0, 0.7}) {
    const RollPitchYaw angles = RollPitchYaw::of(RollPitchYaw{-2.5, pitch, 3.0}.rotation());
    EXPECT_NEAR(angles.roll, -2.5, 1e-9);
    EXPECT_NEAR(angles.pitch, pitch, 1e-9);
    EXPECT_NEAR(angles.yaw, 3.0, 1e-9);
  }
}

TEST(RollPitchYaw, AllIsYawWhereTheXAxisIsVertical) {
  const Eigen::Matrix3d R = RollPitchYaw{0.4, 0.5 * kPi, 1.0}.rotation();
  const RollPitchYaw angles = RollPitchYaw::of(R);
  EXPECT_DOUBLE_EQ(angles.roll, 0.0);
  EXPECT_NEAR(angles.pitch, 0.5 * kPi, 1e-9);
  EXPECT_NEAR(angles.yaw, 0.6, 1e-9);
  EXPECT_TRUE(angles.rotation().isApprox(R, 1e-9));
}

TEST(OpticalAxes, AreNamedByRep103) {
  const Eigen::Matrix3d R_body_optical = opticalToBody();
  EXPECT_EQ(R_body_optical * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX());   // into the image: forward
  EXPECT_EQ(R_body_optical * Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY());  // right is not left
  EXPECT_EQ(R_body_optical * Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ());  // down is not up
}

}  // namespace
}  // namespace stereo_nav
