// Turns that the images show, and an IMU with one of the usual mistakes.
#include "odometry/method/imu_contradiction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "core/angles.h"
#include "core/optical_axes.h"
#include "core/roll_pitch_yaw.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kStart_s = 100.0, kFrame_s = 0.1, kSample_s = 0.005;

/// Rates of the IMU's axes, rad/s, at a time.
using Rates = std::function<Eigen::Vector3d(double time_s)>;

Eigen::Vector3d allAxes(double time_s) {
  return {0.3 * std::sin(2.0 * time_s), 0.4 * std::cos(1.3 * time_s), 0.5 * std::sin(0.9 * time_s + 0.5)};
}

/// What a robot does that drives over even ground.
Eigen::Vector3d yawOnly(double time_s) {
  return {0.0, 0.0, 0.3 + 0.3 * std::sin(time_s)};
}

/// A camera that looks ahead, and an IMU that sits in base_link's axes.
SensorAxes straightAxes() {
  return {opticalToBody(), Eigen::Matrix3d::Identity()};
}

class ImuContradictionTest : public testing::Test {
 protected:
  /// The images show `rates` for some seconds; the IMU sends `sent` as they say it at the same time, its
  /// stamps `late_s` late.
  void turn(double duration_s, const Rates& rates, const Rates& sent, double late_s = 0.0) {
    for (double t = kStart_s - 2.0; t < kStart_s + duration_s + 2.0; t += kSample_s) {
      ImuSample sample;
      sample.time_s = t + late_s;
      sample.angular_velocity = sent(t);
      imu_.add(sample);
    }
    for (double t = kStart_s; t < kStart_s + duration_s - 1e-9; t += kFrame_s) addFrame(t, rates);
  }

  void addFrame(double time_s, const Rates& rates) {
    Eigen::Matrix3d R_previous_current = Eigen::Matrix3d::Identity();
    for (double t = time_s; t < time_s + kFrame_s - 1e-9; t += kSample_s)
      R_previous_current = R_previous_current * expRotation(rates(t + 0.5 * kSample_s) * kSample_s);
    const Eigen::Matrix3d R_camera_imu = straightAxes().R_camera_imu();
    const Eigen::Vector3d noise =
        1e-3 * Eigen::Vector3d(normal_(random_), normal_(random_), normal_(random_));
    contradiction_.add(
        time_s, time_s + kFrame_s,
        expRotation(noise) * R_camera_imu * R_previous_current.transpose() * R_camera_imu.transpose());
  }

  std::string found() { return contradiction_.find(imu_).value_or(""); }

  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
  RotationHistory imu_;
  ImuContradiction contradiction_{straightAxes()};
};

testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << text << "' lacks '" << part << "'";
}

TEST_F(ImuContradictionTest, AGoodImuWithBiasAndNoiseIsBelieved) {
  turn(5.0, allAxes, [this](double t) -> Eigen::Vector3d {
    const Eigen::Vector3d noise(normal_(random_), normal_(random_), normal_(random_));
    return allAxes(t) + Eigen::Vector3d(0.08, -0.05, 0.1) + 0.02 * noise;
  });
  EXPECT_EQ(found(), "");
  EXPECT_FALSE(contradiction_.isSuspected(imu_));
}

TEST_F(ImuContradictionTest, ARigAtRestTellsNothing) {
  const Rates rest = [](double) -> Eigen::Vector3d { return Eigen::Vector3d::Zero(); };
  turn(5.0, rest, [](double) -> Eigen::Vector3d { return {0.1, 0.1, -0.1}; });
  EXPECT_EQ(found(), "");
}

TEST_F(ImuContradictionTest, DegreesAreNamed) {
  const Eigen::Vector3d bias_deg_s(2.0, -1.0, 3.0);
  turn(2.0, yawOnly, [&](double t) -> Eigen::Vector3d { return kDegPerRad * yawOnly(t) + bias_deg_s; });
  EXPECT_TRUE(contradiction_.isSuspected(imu_));
  EXPECT_TRUE(contains(found(), "rates are in deg/s"));
}

TEST_F(ImuContradictionTest, ReversedSignsAreNamed) {
  turn(3.0, allAxes, [](double t) -> Eigen::Vector3d { return -allAxes(t); });
  EXPECT_TRUE(contains(found(), "the signs of its axes are reversed"));
}

TEST_F(ImuContradictionTest, AnOrientationThatStaysTheSameIsNamed) {
  turn(2.0, yawOnly, yawOnly);
  RotationHistory dead;
  for (double t = kStart_s - 1.0; t < kStart_s + 3.0; t += kSample_s) {
    ImuSample sample;
    sample.time_s = t;
    sample.q_world_imu = Eigen::Quaterniond::Identity();
    sample.angular_velocity = yawOnly(t);
    dead.add(sample);
  }
  EXPECT_TRUE(contains(contradiction_.find(dead).value_or(""), "stay the same while it turns"));
}

TEST_F(ImuContradictionTest, AnOrientationThatJumpsAndThenStaysTheSameIsNamed) {
  turn(2.0, yawOnly, yawOnly);
  RotationHistory stopped;
  for (double t = kStart_s - 1.0; t < kStart_s + 3.0; t += kSample_s) {
    ImuSample sample;
    sample.time_s = t;
    const double yaw_rad = t < kStart_s + 0.2 ? 0.4 : 0.0;
    sample.q_world_imu = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
    stopped.add(sample);
  }
  EXPECT_TRUE(contains(contradiction_.find(stopped).value_or(""), "stay the same while it turns"));
}

TEST_F(ImuContradictionTest, OneAtRestIsNotTakenForDeadWhenTheSceneSeemsToTurnForAMoment) {
  turn(1.5, yawOnly, [](double t) { return Eigen::Vector3d(1e-3, 2e-3, 1e-3 * std::sin(50.0 * t)); });
  EXPECT_EQ(found(), "") << "people who walk by look the same; half a radian in 30 frames has to contradict";
}

TEST_F(ImuContradictionTest, ExchangedAxesGiveTheLineForTheRigFile) {
  // The IMU is turned by 90 degrees to the left, and tf does not know.
  const Eigen::Matrix3d R_base_imu = RollPitchYaw::fromDegrees(0.0, 0.0, 90.0).rotation();
  turn(5.0, allAxes, [&](double t) -> Eigen::Vector3d { return R_base_imu.transpose() * allAxes(t); });
  EXPECT_TRUE(contains(found(), "yaw_deg: 90"));
  EXPECT_TRUE(contains(found(), "`imu` needs roll_deg: "));
}

TEST_F(ImuContradictionTest, TurnsAboutOneAxisDoNotTellTheWholeMounting) {
  turn(3.0, yawOnly, [](double t) -> Eigen::Vector3d { return {yawOnly(t).z(), 0.0, 0.0}; });
  EXPECT_TRUE(contains(found(), "turn the rig about a second axis"));
}

TEST_F(ImuContradictionTest, AConstantDelayIsMeasured) {
  const Rates fast = [](double t) -> Eigen::Vector3d { return 3.0 * allAxes(4.0 * t); };
  turn(4.0, fast, fast, 0.2);
  EXPECT_TRUE(contains(found(), "stamps are 0.200 s too late"));
}

TEST_F(ImuContradictionTest, WhatNothingExplainsIsStillSaid) {
  turn(4.0, allAxes, [](double t) -> Eigen::Vector3d { return 4.0 * allAxes(7.0 * t + 1.0); });
  EXPECT_TRUE(contains(found(), "is it fixed to the rig"));
}

TEST_F(ImuContradictionTest, AGapOfAMinuteTellsNothing) {
  contradiction_.add(kStart_s, kStart_s + 60.0, expRotation(Eigen::Vector3d(0.0, 1.0, 0.0)));
  EXPECT_EQ(found(), "");
  turn(3.0, allAxes, [](double t) -> Eigen::Vector3d { return -allAxes(t); });
  EXPECT_TRUE(contains(found(), "reversed"));
}

TEST_F(ImuContradictionTest, OldTurnsAreForgotten) {
  turn(10.0, allAxes,
       [](double t) -> Eigen::Vector3d { return t < kStart_s + 4.5 ? -allAxes(t) : allAxes(t); });
  EXPECT_EQ(found(), "");
}

}  // namespace
}  // namespace stereo_nav::odometry
