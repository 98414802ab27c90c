// Scans that tell nothing or lie: the pose does not jump, and is right again with the next good ones.
#include <gtest/gtest.h>

#include <limits>

#include "walled_world.h"

namespace stereo_nav::odometry {
namespace {

/// A wheel-driven round through a room, with scans altered by `disturb`; no step may be 5 cm beyond the true
/// motion. Returns the error at the end.
Eigen::Vector3d driveDisturbed(const std::function<void(int, LaserScan&, std::mt19937&)>& disturb) {
  const PlanarPath path = [](double t) {
    return Eigen::Vector3d(1.2 * std::sin(0.3 * t), 0.8 * std::sin(0.6 * t), 0.25 * std::sin(0.5 * t));
  };
  TurningLaser laser{WalledWorld::room(7.0, 5.0), path};
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 1.0);
  LaserOdometry odometry{LaserParams()};
  double fed_s = -0.02;
  Eigen::Isometry2d T_wheels = planarPose(path(fed_s));
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (int i = 0; i < 300; ++i) {
    for (; fed_s <= 0.1 * i + 0.14; fed_s += 0.02) {
      odometry.inputs().addWheels(fed_s, T_wheels);
      const Eigen::Isometry2d step = planarPose(path(fed_s)).inverse() * planarPose(path(fed_s + 0.02));
      T_wheels =
          T_wheels * step * planarPose({3e-4 * noise(random), 3e-4 * noise(random), 3e-4 * noise(random)});
    }
    LaserScan scan = laser.scan(0.1 * i);
    disturb(i, scan, random);
    const LaserOdometryResult result = odometry.process(scan, Eigen::Isometry3d::Identity());
    const Eigen::Vector3d error = poseError(result, path, 0.0);
    EXPECT_LT((error - before).head<2>().norm(), 0.05) << "scan " << i << " " << result.reason;
    EXPECT_LT(std::abs(error.z() - before.z()), 0.03) << "scan " << i << " " << result.reason;
    before = error;
  }
  return before;
}

TEST(LaserDisturbance, oneScanInTwentyIsGarbage) {
  const Eigen::Vector3d error = driveDisturbed([](int i, LaserScan& scan, std::mt19937& random) {
    std::uniform_real_distribution<float> any(0.1F, 12.0F);
    if (i % 20 == 10)
      for (float& range : scan.ranges_m) range = any(random);
  });
  EXPECT_LT(error.head<2>().norm(), 0.03);
}

TEST(LaserDisturbance, rangesAreNan) {
  const Eigen::Vector3d error = driveDisturbed([](int i, LaserScan& scan, std::mt19937&) {
    for (std::size_t k = 0; k < scan.ranges_m.size(); ++k)
      if (i % 7 == 3 || k % 3 == 0) scan.ranges_m[k] = std::numeric_limits<float>::quiet_NaN();
  });
  EXPECT_LT(error.head<2>().norm(), 0.03);
}

TEST(LaserDisturbance, theLaserIsCoveredForFiveSeconds) {
  const Eigen::Vector3d error = driveDisturbed([](int i, LaserScan& scan, std::mt19937&) {
    if (i >= 120 && i < 170)
      std::fill(scan.ranges_m.begin(), scan.ranges_m.end(), -std::numeric_limits<float>::infinity());
  });
  EXPECT_LT(error.head<2>().norm(), 0.03);
}

TEST(LaserDisturbance, aCrowdOfLegsWalksAlong) {
  const Eigen::Vector3d error = driveDisturbed([](int i, LaserScan& scan, std::mt19937&) {
    // Twelve legs of 12 cm width, 0.8 to 2 m away, that circle around the robot.
    for (int leg = 0; leg < 12; ++leg) {
      const double distance_m = 0.8 + 0.1 * leg;
      const double angle_deg = 30.0 * leg + 8.0 * std::sin(0.3 * i + leg) + 0.5 * i;
      const int half = static_cast<int>(kDegPerRad * 0.06 / distance_m);
      for (int k = -half; k <= half; ++k) {
        const auto beam = static_cast<std::size_t>((static_cast<int>(angle_deg) + k + 720) % 360);
        scan.ranges_m[beam] = std::min(scan.ranges_m[beam], static_cast<float>(distance_m));
      }
    }
  });
  EXPECT_LT(error.head<2>().norm(), 0.03);
}

}  // namespace
}  // namespace stereo_nav::odometry
