// Known rooms, known drives: what the laser odometry makes of them.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "core/planar_motion.h"
#include "stereo_nav/core/input_error.h"
#include "walled_world.h"

namespace stereo_nav::odometry {
namespace {

using LaserState = LaserOdometryResult::State;
const Eigen::Isometry3d kAtBase = Eigen::Isometry3d::Identity();

/// A circle of 1 m through a room, 0.4 m/s after a start from rest.
Eigen::Vector3d circle(double time_s) {
  const double driven_s = time_s < 1.0   ? 0.0
                          : time_s < 2.0 ? 0.5 * (time_s - 1.0) * (time_s - 1.0)
                                         : time_s - 1.5;
  const double angle_rad = 0.4 * driven_s;
  return {std::sin(angle_rad), 1.0 - std::cos(angle_rad) - 0.5, angle_rad};
}

/// Wheels and gyroscope without an error up to a time.
void feedExactly(LaserOdometry& odometry, const PlanarPath& path, double& fed_s, double to_s) {
  for (; fed_s <= to_s + 0.02; fed_s += 0.01) {
    odometry.inputs().addWheels(fed_s, planarPose(path(fed_s)));
    ImuSample sample;
    sample.time_s = fed_s;
    sample.angular_velocity =
        Eigen::Vector3d(0.0, 0.0, (path(fed_s + 0.005).z() - path(fed_s - 0.005).z()) / 0.01);
    odometry.inputs().addImu(sample, Eigen::Matrix3d::Identity());
  }
}

TEST(LaserOdometry, aCircleInARoomByTheLaserAlone) {
  TurningLaser laser{WalledWorld::room(7.0, 5.0), circle};
  LaserOdometry odometry{LaserParams()};
  for (int i = 0; i < 300; ++i) {
    const LaserOdometryResult result = odometry.process(laser.scan(0.1 * i), kAtBase);
    EXPECT_EQ(result.state, LaserState::kTracking) << result.reason;
    const Eigen::Vector3d error = poseError(result, circle, 0.0);
    ASSERT_LT(error.head<2>().norm(), 0.03) << "scan " << i;
    ASSERT_LT(std::abs(error.z()), 0.01) << "scan " << i;
  }
}

TEST(LaserOdometry, aCorridorIsToldAsOneAndTheWheelsGoOn) {
  const PlanarPath straight = [](double t) { return Eigen::Vector3d(0.4 * t, 0.0, 0.0); };
  TurningLaser laser{WalledWorld::corridor(2.0), straight};
  LaserOdometry odometry{LaserParams()};
  double fed_s = -0.1;
  for (int i = 0; i < 200; ++i) {
    feedExactly(odometry, straight, fed_s, 0.1 * i + 0.1);
    const LaserOdometryResult result = odometry.process(laser.scan(0.1 * i), kAtBase);
    if (i == 0) continue;
    ASSERT_EQ(result.state, LaserState::kPartly) << "scan " << i;
    ASSERT_EQ(result.untold.size(), 1u);
    EXPECT_GT(std::abs(result.untold[0].x()), 0.99);
    const Eigen::Vector3d error = poseError(result, straight, 0.0);
    ASSERT_LT(std::abs(error.x()), 0.02) << "scan " << i;
    ASSERT_LT(std::abs(error.y()), 0.01) << "scan " << i;
    if (i == 199) {
      // Across it is known by the walls, along by the wheels alone.
      EXPECT_GT(result.pose_covariance(0, 0), 25.0 * result.pose_covariance(1, 1));
    }
  }
}

TEST(LaserOdometry, aSpinningSensorDoesNotJump) {
  const PlanarPath spin = [](double t) { return Eigen::Vector3d(0.3, 0.2, t < 1.0 ? 0.0 : kPi * (t - 1.0)); };
  for (const bool with_gyroscope : {false, true}) {
    TurningLaser laser{WalledWorld::room(6.0, 4.0), spin};
    LaserOdometry odometry{LaserParams()};
    double fed_s = -0.1;
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    for (int i = 0; i < 80; ++i) {
      if (with_gyroscope) feedExactly(odometry, spin, fed_s, 0.1 * i + 0.1);
      const LaserOdometryResult result = odometry.process(laser.scan(0.1 * i), kAtBase);
      const Eigen::Vector3d error = poseError(result, spin, 0.0);
      ASSERT_LT((error - before).head<2>().norm(), 0.05) << "scan " << i << " " << result.reason;
      before = error;
    }
    EXPECT_LT(before.head<2>().norm(), 0.05);
    EXPECT_LT(std::abs(before.z()), 0.03);
  }
}

TEST(LaserOdometry, atRestItRests) {
  TurningLaser laser{WalledWorld::room(7.0, 5.0), [](double) { return Eigen::Vector3d(0.5, 0.3, 0.2); }};
  LaserOdometry odometry{LaserParams()};
  for (int i = 0; i < 600; ++i) {
    const LaserOdometryResult result = odometry.process(laser.scan(0.1 * i), kAtBase);
    ASSERT_LT(result.T_odom_base.translation().norm(), 0.01) << "scan " << i;
    ASSERT_LT(std::abs(result.T_odom_base(1, 0)), 0.003) << "scan " << i;
  }
}

TEST(LaserOdometry, aScaleErrorOfTheWheelsIsLearnt) {
  TurningLaser laser{WalledWorld::room(7.0, 5.0), circle};
  LaserOdometry odometry{LaserParams()};
  double fed_s = 0.0;
  for (int i = 0; i < 150; ++i) {
    for (; fed_s <= 0.1 * i + 0.12; fed_s += 0.02) {
      const Eigen::Vector3d truth = circle(fed_s);
      // The wheels count a tenth too much: a circle of 1.1 m.
      odometry.inputs().addWheels(fed_s, planarPose({1.1 * truth.x(), 1.1 * truth.y(), truth.z()}));
    }
    odometry.process(laser.scan(0.1 * i), kAtBase);
  }
  EXPECT_NEAR(odometry.filter().state().correction.x(), 1.0 / 1.1 - 1.0, 0.02);
}

TEST(LaserOdometry, theCovarianceIsAsLargeAsTheErrors) {
  double nees = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    TurningLaser laser{WalledWorld::room(7.0, 5.0), circle, 0.02};
    laser.random.seed(seed);
    LaserOdometry odometry{LaserParams()};
    LaserOdometryResult result;
    for (int i = 0; i < 60; ++i) result = odometry.process(laser.scan(0.1 * i), kAtBase);
    const Eigen::Isometry2d truth = planarPose(circle(0.0)).inverse() * planarPose(circle(result.time_s));
    Eigen::Vector3d error;
    error.head<2>() = result.T_odom_base.translation() - truth.translation();
    error.z() = poseError(result, circle, 0.0).z();
    nees += error.dot(result.pose_covariance.ldlt().solve(error));
    ++count;
  }
  EXPECT_GT(nees / count, 0.5);
  EXPECT_LT(nees / count, 9.0);
}

TEST(LaserOdometry, stampsMustIncreaseAndAPoseCanBeSet) {
  TurningLaser laser{WalledWorld::room(7.0, 5.0), circle};
  LaserOdometry odometry{LaserParams()};
  odometry.process(laser.scan(1.0), kAtBase);
  EXPECT_THROW(odometry.process(laser.scan(1.0), kAtBase), InputError);
  const Eigen::Isometry2d set = planarPose({5.0, 6.0, 1.0});
  odometry.setPose(set, 0.01 * Eigen::Matrix3d::Identity());
  LaserOdometryResult result;
  for (int i = 1; i < 20; ++i) result = odometry.process(laser.scan(1.0 + 0.1 * i), kAtBase);
  const Eigen::Isometry2d expected =
      set * (planarPose(circle(1.0)).inverse() * planarPose(circle(result.time_s)));
  EXPECT_LT((result.T_odom_base.translation() - expected.translation()).norm(), 0.06);
  EXPECT_GT(result.pose_covariance(0, 0), 0.009);
}

}  // namespace
}  // namespace stereo_nav::odometry
