#include "core/rotation_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace stereo_nav {
namespace {

const Eigen::Vector3d kAxis = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();

ImuSample attitudeSample(double time_s, double angle_rad) {
  ImuSample sample;
  sample.time_s = time_s;
  sample.q_world_imu = Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, kAxis));
  return sample;
}

ImuSample rateSample(double time_s, double rate_rad_s) {
  ImuSample sample;
  sample.time_s = time_s;
  sample.angular_velocity = rate_rad_s * kAxis;
  return sample;
}

/// Signed angle about kAxis by which the IMU turned, from a rotation "to <- from".
double turnOf(const Eigen::Matrix3d& R_current_previous) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(R_current_previous.transpose()));
  return turn.angle() * turn.axis().dot(kAxis);
}

TEST(RotationHistory, AttitudesAreInterpolatedAtBothEnds) {
  RotationHistory history;
  for (int i = 0; i <= 10; ++i) history.add(attitudeSample(0.1 * i, 0.2 * i));
  const auto R_current_previous = history.increment(0.13, 0.77);
  ASSERT_TRUE(R_current_previous);
  EXPECT_NEAR(turnOf(*R_current_previous), 2.0 * 0.64, 1e-9);
}

TEST(RotationHistory, AChangingRateIsIntegratedExactlyBetweenTheEnds) {
  // rate = 2 t: angle(t) = t^2. Linear between samples, so the integral is exact.
  RotationHistory history;
  for (int i = 0; i <= 100; ++i) history.add(rateSample(0.01 * i, 0.02 * i));
  const auto R_current_previous = history.increment(0.1234, 0.5678);
  ASSERT_TRUE(R_current_previous);
  EXPECT_NEAR(turnOf(*R_current_previous), 0.5678 * 0.5678 - 0.1234 * 0.1234, 1e-9);
}

TEST(RotationHistory, BackwardsIsTheInverse) {
  RotationHistory history;
  for (int i = 0; i <= 100; ++i) history.add(rateSample(0.01 * i, 1.5));
  const Eigen::Matrix3d product = *history.increment(0.2, 0.6) * *history.increment(0.6, 0.2);
  EXPECT_TRUE(product.isIdentity(1e-12));
}

TEST(RotationHistory, YawAcross180DegreesIsASmallTurn) {
  RotationHistory history;
  ImuSample sample;
  for (int i = 0; i <= 10; ++i) {
    sample.time_s = 0.1 * i;
    const double yaw = std::remainder(3.0 + 0.05 * i, 2.0 * M_PI);
    sample.q_world_imu = Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    history.add(sample);
  }
  EXPECT_NEAR(Eigen::AngleAxisd(*history.increment(0.0, 1.0)).angle(), 0.5, 1e-9);
}

TEST(RotationHistory, NothingOutsideTheSamplesOrAcrossAHole) {
  RotationHistory history;
  EXPECT_FALSE(history.increment(0.0, 0.1));
  history.add(rateSample(0.0, 1.0));
  history.add(rateSample(0.1, 1.0));
  history.add(rateSample(0.1 + 2.0 * RotationHistory::kMaxGap_s, 1.0));
  EXPECT_TRUE(history.increment(0.0, 0.1));
  EXPECT_FALSE(history.increment(-0.01, 0.1));
  EXPECT_FALSE(history.increment(0.05, 0.2));
  EXPECT_FALSE(history.increment(0.05, 5.0));
}

TEST(RotationHistory, OldDoubleAndBrokenSamplesAreIgnored) {
  RotationHistory history;
  EXPECT_TRUE(history.add(rateSample(1.0, 1.0)));
  EXPECT_FALSE(history.add(rateSample(1.0, 1.0)));
  EXPECT_FALSE(history.add(rateSample(0.5, 1.0)));
  EXPECT_FALSE(history.add(rateSample(1.1, std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(history.newest_s(), 1.0);
}

}  // namespace
}  // namespace stereo_nav
