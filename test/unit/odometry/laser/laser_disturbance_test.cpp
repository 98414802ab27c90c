// Scans that tell nothing or lie: the pose does not jump, and is right again with the next good ones.
#include <gtest/gtest.h>

#include <limits>

#include "walled_world.h"

namespace stereo_nav::odometry {
namespace {

/// Alters a scan by its number, and says whether it did.
using Disturbance = std::function<bool(int, LaserScan&, std::mt19937&)>;

/// Turns both ways and drives on an eight.
Eigen::Vector3d eight(double t) {
  return {1.2 * std::sin(0.3 * t), 0.8 * std::sin(0.6 * t), 0.25 * std::sin(0.5 * t)};
}

/// Noisy wheels along the eight.
class EightByWheels {
 public:
  void feed(const std::vector<LaserOdometry*>& odometries, double to_s, std::mt19937& random) {
    std::normal_distribution<double> noise(0.0, 3e-4);
    for (; fed_s_ <= to_s; fed_s_ += 0.02) {
      for (LaserOdometry* odometry : odometries) odometry->inputs().addWheels(fed_s_, T_wheels_);
      const Eigen::Isometry2d step = planarPose(eight(fed_s_)).inverse() * planarPose(eight(fed_s_ + 0.02));
      const double along = noise(random), across = noise(random);
      T_wheels_ = T_wheels_ * step * planarPose({along, across, noise(random)});
    }
  }

 private:
  double fed_s_ = -0.02;
  Eigen::Isometry2d T_wheels_ = planarPose(eight(-0.02));
};

/// A round through a room. No step may be 5 cm beyond the true motion, and with the third scan after
/// disturbed ones the pose is again what it is for an odometry that was not disturbed.
void driveDisturbed(bool with_wheels, const Disturbance& disturb) {
  constexpr int kRecovered = 3;
  TurningLaser laser{WalledWorld::room(7.0, 5.0), eight};
  std::mt19937 random(7);
  EightByWheels wheels;
  LaserOdometry odometry{LaserParams()}, undisturbed{LaserParams()};
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  int good = 0;
  for (int i = 0; i < 310; ++i) {
    if (with_wheels) wheels.feed({&odometry, &undisturbed}, 0.1 * i + 0.14, random);
    LaserScan scan = laser.scan(0.1 * i);
    const LaserOdometryResult expected = undisturbed.process(scan, Eigen::Isometry3d::Identity());
    good = disturb(i, scan, random) ? 0 : good + 1;
    const LaserOdometryResult result = odometry.process(scan, Eigen::Isometry3d::Identity());
    const Eigen::Vector3d error = poseError(result, eight, 0.0);
    EXPECT_LT((error - before).head<2>().norm(), 0.05) << "scan " << i << " " << result.reason;
    EXPECT_LT(std::abs(error.z() - before.z()), 0.03) << "scan " << i << " " << result.reason;
    before = error;
    if (good < kRecovered) continue;
    EXPECT_EQ(result.state, LaserOdometryResult::State::kTracking) << "scan " << i << " " << result.reason;
    const Eigen::Vector3d apart = logPlanar(expected.T_odom_base.inverse() * result.T_odom_base);
    EXPECT_LT(apart.head<2>().norm(), 0.03) << "scan " << i;
    EXPECT_LT(std::abs(apart.z()), 0.01) << "scan " << i;
  }
  EXPECT_GE(good, kRecovered);
  EXPECT_LT(before.head<2>().norm(), with_wheels ? 0.03 : 0.05);
}

TEST(LaserDisturbance, oneScanInTwentyIsGarbage) {
  for (const bool with_wheels : {true, false}) {
    SCOPED_TRACE(with_wheels ? "wheels" : "the laser alone");
    driveDisturbed(with_wheels, [](int i, LaserScan& scan, std::mt19937& random) {
      if (i % 20 != 10) return false;
      std::uniform_real_distribution<float> any(0.1F, 12.0F);
      for (float& range : scan.ranges_m) range = any(random);
      return true;
    });
  }
}

TEST(LaserDisturbance, rangesAreNan) {
  for (const bool with_wheels : {true, false}) {
    SCOPED_TRACE(with_wheels ? "wheels" : "the laser alone");
    driveDisturbed(with_wheels, [](int i, LaserScan& scan, std::mt19937&) {
      const bool all = i % 7 == 3;
      for (std::size_t k = 0; k < scan.ranges_m.size(); ++k)
        if (all || k % 3 == 0) scan.ranges_m[k] = std::numeric_limits<float>::quiet_NaN();
      return all;
    });
  }
}

TEST(LaserDisturbance, theLaserIsCoveredForFiveSeconds) {
  driveDisturbed(true, [](int i, LaserScan& scan, std::mt19937&) {
    if (i < 120 || i >= 170) return false;
    std::fill(scan.ranges_m.begin(), scan.ranges_m.end(), -std::numeric_limits<float>::infinity());
    return true;
  });
}

TEST(LaserDisturbance, aCrowdOfLegsWalksAlong) {
  for (const bool with_wheels : {true, false}) {
    SCOPED_TRACE(with_wheels ? "wheels" : "the laser alone");
    driveDisturbed(with_wheels, [](int i, LaserScan& scan, std::mt19937&) {
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
      return false;  // they are there all the time, and the pose has to be right nevertheless
    });
  }
}

}  // namespace
}  // namespace stereo_nav::odometry
