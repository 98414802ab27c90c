#include "nodes/wheel_odometry/wheel_session.h"

#include <gtest/gtest.h>

#include "kinematics/layouts.h"
#include "unit/odometry/wheel/driven_wheels.h"

namespace stereo_nav::nodes {
namespace {

constexpr double kPeriod_s = 0.02;
constexpr double kImuWait_s = 0.05;

class WheelSessionTest : public testing::Test {
 protected:
  WheelSessionTest() : base_(drive_), session_(odometry::odometryOf(drive_), kImuWait_s) {}

  /// Moves on and reads the counters, at the time of their stamp.
  WheelSessionOutput step(const kinematics::Twist& twist = {0.5, 0.0, 0.5}) {
    base_.move(twist, kPeriod_s);
    session_.addSample(base_.sample(false), base_.sample(false).time_s);
    return session_.take(base_.sample(false).time_s);
  }

  ImuSample imuAt(double time_s, double turn_rad_per_s) const {
    ImuSample sample;
    sample.time_s = time_s;
    sample.angular_velocity = Eigen::Vector3d(0.0, 0.0, turn_rad_per_s);
    return sample;
  }

  kinematics::DriveParams drive_ = kinematics::differentialDrive(0.4, 0.05);
  odometry::DrivenWheels base_;
  WheelSession session_;
};

TEST_F(WheelSessionTest, withoutAnImuEveryReadingIsDueAtOnce) {
  for (int i = 0; i < 10; ++i) EXPECT_EQ(step().results.size(), 1u);
  EXPECT_EQ(session_.readings(), 10u);
}

TEST_F(WheelSessionTest, aReadingWaitsForTheImuButNotForever) {
  session_.setImuMounting(Eigen::Matrix3d::Identity());
  session_.addImu(imuAt(0.0, 0.5));
  EXPECT_TRUE(step().results.empty());
  session_.addImu(imuAt(0.03, 0.5));
  EXPECT_EQ(session_.take(0.03).results.size(), 1u);
  EXPECT_TRUE(step().results.empty());
  EXPECT_TRUE(session_.take(0.04 + 0.9 * kImuWait_s).results.empty());
  EXPECT_EQ(session_.take(0.04 + 1.1 * kImuWait_s).results.size(), 1u);
  EXPECT_EQ(session_.readingsWithoutImu(), 1u);
  for (int i = 0; i < 100; ++i) step();
  EXPECT_EQ(step().results.size(), 1u) << "an IMU that has been silent for a second is not waited for";
}

TEST_F(WheelSessionTest, theYawIsTheImus) {
  session_.setImuMounting(Eigen::Matrix3d::Identity());
  double yaw_rad = 0.0;
  for (int i = 0; i < 200; ++i) {
    session_.addImu(imuAt(kPeriod_s * i, 0.3));
    session_.addImu(imuAt(kPeriod_s * (i + 1), 0.3));
    for (const auto& result : step({0.5, 0.0, 0.0}).results) yaw_rad = logPlanar(result.T_odom_base).z();
  }
  EXPECT_NEAR(yaw_rad, 0.3 * 199 * kPeriod_s, 0.02);
}

TEST_F(WheelSessionTest, goesOnFromItsLastPoseWhenTheCountersOrTheClockJump) {
  for (int i = 0; i < 100; ++i) step();
  const double way_m = base_.pose().translation().norm();
  odometry::WheelSample restarted = base_.sample(false);
  restarted.time_s += kPeriod_s;
  restarted.pulses = {-100000, 7};
  session_.addSample(restarted, 10.0);
  auto output = session_.take(10.0);
  ASSERT_EQ(output.announcements.size(), 1u);
  EXPECT_NE(output.announcements[0].find("the counter of left went from"), std::string::npos)
      << output.announcements[0];
  ASSERT_EQ(output.results.size(), 1u);
  EXPECT_NEAR(output.results[0].T_odom_base.translation().norm(), way_m, 0.01);
  EXPECT_GT(output.results[0].pose_covariance(0, 0), 1e-6);
  restarted.time_s -= 1.5;
  session_.addSample(restarted, 10.1);
  output = session_.take(10.1);
  ASSERT_EQ(output.announcements.size(), 1u);
  EXPECT_NE(output.announcements[0].find("went back by 1.5 s"), std::string::npos) << output.announcements[0];
  EXPECT_NEAR(output.results.at(0).T_odom_base.translation().norm(), way_m, 0.01);
  restarted.time_s -= 0.1;
  session_.addSample(restarted, 10.2);
  EXPECT_TRUE(session_.take(10.2).results.empty()) << "a late message";
  EXPECT_EQ(session_.readingsDropped(), 1u);
}

TEST_F(WheelSessionTest, aPoseThatIsSetIsWhereItGoesOn) {
  for (int i = 0; i < 10; ++i) step();
  session_.setPose(expPlanar({3.0, 2.0, 1.0}), 0.01 * Eigen::Matrix3d::Identity());
  const auto output = step();
  EXPECT_NEAR((expPlanar({3.0, 2.0, 1.0}).inverse() * output.results.at(0).T_odom_base).translation().norm(),
              0.01, 2e-3);
  EXPECT_NEAR(output.results[0].pose_covariance(2, 2), 0.01, 1e-3);
}

}  // namespace
}  // namespace stereo_nav::nodes
