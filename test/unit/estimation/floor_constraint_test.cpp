#include "stereo_nav/estimation/floor_constraint.h"

#include <gtest/gtest.h>

#include <random>

namespace stereo_nav::estimation {
namespace {

const FloorParams kFloor{true, 0.01, 0.02};

UncertainPose drifted(double z_m, double pitch_rad, double sigma_m, double sigma_rad) {
  UncertainPose pose;
  pose.T_odom_base.translation() << 3.0, -2.0, z_m;
  pose.T_odom_base.linear() = expRotation({0.0, pitch_rad, 0.0});
  pose.T_odom_base.linear() = expRotation({0.0, 0.0, 1.0}) * pose.T_odom_base.linear();
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(sigma_m * sigma_m), Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
  pose.covariance = variances.asDiagonal();
  return pose;
}

TEST(FloorConstraint, ADriftedPoseComesBackToTheFloorWhereItIs) {
  const UncertainPose before = drifted(0.3, 0.05, 0.2, 0.1);
  const UncertainPose held = onFloor(kFloor, 0.0, before);
  EXPECT_LT(std::abs(held.T_odom_base.translation().z()), 0.001);
  EXPECT_LT(std::acos(held.T_odom_base.linear()(2, 2)), 0.003);
  EXPECT_LT((held.T_odom_base.translation() - before.T_odom_base.translation()).head<2>().norm(), 1e-9);
  EXPECT_NEAR(std::atan2(held.T_odom_base.linear()(1, 0), held.T_odom_base.linear()(0, 0)), 1.0, 0.002);
  EXPECT_NEAR(std::sqrt(held.covariance(2, 2)), kFloor.height_sigma_m, 0.0001)
      << "no better known than the floor itself";
  EXPECT_NEAR(std::sqrt(held.covariance(3, 3)), 0.02 * 0.1 / std::hypot(0.02, 0.1), 1e-6);
  EXPECT_EQ(held.covariance(0, 0), before.covariance(0, 0));
}

TEST(FloorConstraint, APoseThatIsKnownBetterStaysAsItIs) {
  const UncertainPose before = drifted(0.005, 0.01, 1e-5, 1e-5);
  const UncertainPose held = onFloor(kFloor, 0.0, before);
  EXPECT_NEAR(held.T_odom_base.translation().z(), 0.005, 1e-4);
  EXPECT_TRUE(held.T_odom_base.linear().isApprox(before.T_odom_base.linear(), 1e-4));
}

TEST(FloorConstraint, WhatGoesWithTheHeightIsCorrectedToo) {
  UncertainPose before = drifted(0.1, 0.0, 0.1, 0.001);
  before.covariance(0, 2) = before.covariance(2, 0) = 0.5 * 0.1 * 0.1;  // half of it is the same error
  const UncertainPose held = onFloor(kFloor, 0.0, before);
  EXPECT_NEAR(held.T_odom_base.translation().x(), 3.0 - 0.05, 0.001);
  EXPECT_LT(held.covariance(0, 0), 0.8 * before.covariance(0, 0));
}

TEST(FloorConstraint, ARampIsBelieved) {
  // Half a metre up, known within 2 cm: the robot has left the plane.
  const UncertainPose held = onFloor(kFloor, 0.0, drifted(0.5, 0.2, 0.02, 0.01));
  EXPECT_GT(held.T_odom_base.translation().z(), 0.4);
  // Without a step: one that is a little farther up is held a little farther up.
  double previous_m = 0.0;
  for (double z_m = 0.0; z_m < 0.5; z_m += 0.001) {
    const double held_m = onFloor(kFloor, 0.0, drifted(z_m, 0.0, 0.02, 0.01)).T_odom_base.translation().z();
    EXPECT_LT(std::abs(held_m - previous_m), 0.005) << z_m;
    previous_m = held_m;
  }
}

TEST(FloorConstraint, CovariancesAreAsLargeAsTheErrors) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Matrix6d root = Matrix6d::Zero();  // of a covariance in which everything goes together
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column <= row; ++column)
      root(row, column) = (row < 3 ? 0.05 : 0.03) * normal(random);
  }
  double sum = 0.0;
  constexpr int kDraws = 2000;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
    truth.translation() << 1.0, 2.0, kFloor.height_sigma_m * normal(random);
    truth.linear() =
        expRotation({kFloor.tilt_sigma_rad * normal(random), kFloor.tilt_sigma_rad * normal(random), 0.0});
    Vector6d error;
    for (int i = 0; i < 6; ++i) error[i] = normal(random);
    error = root * error;
    UncertainPose pose{truth, root * root.transpose()};
    pose.T_odom_base.translation() -= error.head<3>();
    pose.T_odom_base.linear() = expRotation(-error.tail<3>()) * truth.linear();
    const UncertainPose held = onFloor(kFloor, 0.0, pose);
    Vector6d left;
    left << truth.translation() - held.T_odom_base.translation(),
        logRotation(Eigen::Matrix3d(truth.linear() * held.T_odom_base.linear().transpose()));
    sum += left.dot(held.covariance.ldlt().solve(left));
  }
  EXPECT_NEAR(sum / kDraws / 6.0, 1.0, 0.05);
}

}  // namespace
}  // namespace stereo_nav::estimation
