// How sure the laser odometry is of the way along a corridor, which only wheels tell.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "core/planar_motion.h"
#include "odometry/laser/motion_covariance.h"
#include "walled_world.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kScanPeriod_s = 0.1;
constexpr double kWheelPeriod_s = 0.02;
constexpr double kSpeed_m_per_s = 0.45;

/// At rest for a second, then on for good.
Eigen::Vector3d alongTheCorridor(double time_s) {
  return {kSpeed_m_per_s * std::max(0.0, time_s - 1.0), 0.0, 0.0};
}

/// Wheels 2 % wrong with a noise of 1 cm/s and 6 % of the speed, and a gyroscope with one of 0.1 deg/s.
class NoisyInputs {
 public:
  explicit NoisyInputs(unsigned seed) : random_(seed) {}

  void feed(LaserOdometry& odometry, double to_s) {
    for (; fed_s_ < to_s; fed_s_ += kWheelPeriod_s) {
      odometry.inputs().addWheels(fed_s_, T_wheels_);
      ImuSample sample;
      sample.time_s = fed_s_;
      sample.angular_velocity = Eigen::Vector3d(0.0, 0.0, 0.1 * kRadPerDeg * normal_(random_));
      odometry.inputs().addImu(sample, Eigen::Matrix3d::Identity());
      const double step_m = alongTheCorridor(fed_s_ + kWheelPeriod_s).x() - alongTheCorridor(fed_s_).x();
      const double noise_m = 0.01 * kWheelPeriod_s;
      T_wheels_ = T_wheels_ * expPlanar({1.02 * step_m + (noise_m + 0.06 * step_m) * normal_(random_),
                                         noise_m * normal_(random_), 0.0});
    }
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
  double fed_s_ = -0.1;
  Eigen::Isometry2d T_wheels_ = Eigen::Isometry2d::Identity();
};

/// Squared errors, normalised, of the motions over pieces of 5 s; 3 is expected.
std::vector<double> normalisedErrors(unsigned seed) {
  constexpr int kScansOfPiece = 50;
  WalledWorld world = WalledWorld::corridor(2.0);
  world.walls.push_back({{-2.0, -1.0}, {-2.0, 1.0}});  // the scans of the start tell the scale of the wheels
  TurningLaser laser{world, alongTheCorridor};
  laser.random.seed(seed);
  NoisyInputs inputs(seed);
  LaserOdometry odometry{LaserParams()};
  std::vector<double> squares;
  FilterMoment start;
  Matrix9d carry = Matrix9d::Identity();
  for (int i = 0; i <= 600; ++i) {
    const double time_s = kScanPeriod_s * i;
    inputs.feed(odometry, time_s + 2.0 * kScanPeriod_s);
    odometry.process(laser.scan(time_s), Eigen::Isometry3d::Identity());
    carry = (odometry.filter().transition() * carry).eval();
    if (i % kScansOfPiece != 0) continue;
    const FilterMoment end = momentOf(odometry.filter());
    if (i > 2 * kScansOfPiece) {
      const double way_m =
          alongTheCorridor(time_s).x() - alongTheCorridor(time_s - kScansOfPiece * kScanPeriod_s).x();
      const Eigen::Vector3d error =
          logPlanar(planarPose({way_m, 0.0, 0.0}).inverse() * start.T_odom_base.inverse() * end.T_odom_base);
      squares.push_back(error.dot(motionCovariance(start, carry, end).ldlt().solve(error)));
    }
    start = end;
    carry.setIdentity();
  }
  return squares;
}

TEST(LaserCorridor, theWayAlongItIsBetterThanItsCovariance) {
  double sum = 0.0;
  std::size_t count = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    for (const double square : normalisedErrors(seed)) {
      sum += square;
      ++count;
    }
  }
  const double nees = sum / static_cast<double>(count);
  EXPECT_LT(nees, 5.0) << "the covariance is too small";
  // Expected to fail: 1.5 is not reached; docs/laser_odometry.md says what holds it back.
  EXPECT_LT(nees, 1.5) << "the bound is met now: turn this check around, and tell docs/laser_odometry.md";
  EXPECT_GT(nees, 0.3);
}

}  // namespace
}  // namespace stereo_nav::odometry
