#include "odometry/wheel/imu_yaw.h"

#include <gtest/gtest.h>

#include "core/angles.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kTurn_rad_per_s = 1.5;

/// A base that turns, with an IMU that lies on its side: its x axis points up.
ImuSample sampleAt(double time_s, const Eigen::Matrix3d& R_base_imu, bool attitude) {
  ImuSample sample;
  sample.time_s = time_s;
  const Eigen::Matrix3d R_world_base =
      Eigen::AngleAxisd(kTurn_rad_per_s * time_s, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  if (attitude) {
    sample.q_world_imu = Eigen::Quaterniond(R_world_base * R_base_imu);
  } else {
    sample.angular_velocity = R_base_imu.transpose() * Eigen::Vector3d(0.0, 0.0, kTurn_rad_per_s);
  }
  return sample;
}

TEST(ImuYaw, countsWholeTurnsWhateverTheMounting) {
  const Eigen::Matrix3d R_base_imu =
      Eigen::AngleAxisd(-0.5 * kPi, Eigen::Vector3d::UnitY()).toRotationMatrix();
  for (const bool attitude : {true, false}) {
    ImuYaw yaw(R_base_imu);
    double next_s = 0.0;
    std::optional<double> seen;
    for (double time_s = 0.003; time_s < 20.0; time_s += 0.017) {
      for (; next_s < time_s + 0.01; next_s += 0.01) yaw.add(sampleAt(next_s, R_base_imu, attitude));
      seen = yaw.at(time_s);
      ASSERT_TRUE(seen);
      EXPECT_NEAR(*seen, kTurn_rad_per_s * (time_s - 0.003), 1e-6);
    }
  }
}

TEST(ImuYaw, saysNothingAcrossAGap) {
  const Eigen::Matrix3d R_base_imu = Eigen::Matrix3d::Identity();
  ImuYaw yaw(R_base_imu);
  for (double time_s = 0.0; time_s < 3.0; time_s += 0.01)
    if (time_s < 1.0 || time_s > 2.0) yaw.add(sampleAt(time_s, R_base_imu, true));
  EXPECT_TRUE(yaw.at(0.5));
  EXPECT_FALSE(yaw.at(1.5));
  EXPECT_FALSE(yaw.at(2.5)) << "the turn since 1.5 s is not known";
  EXPECT_TRUE(yaw.at(2.6));
}

}  // namespace
}  // namespace stereo_nav::odometry
