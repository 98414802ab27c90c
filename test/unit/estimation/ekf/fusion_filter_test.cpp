#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "fusion_scene.h"

namespace stereo_nav::estimation::test {
namespace {

Measurement wheelsAt(double time_s, double speed_m_s) {
  Measurement measurement;
  measurement.channel = channel::kWheels;
  measurement.time_s = time_s;
  measurement.kind = Measurement::Kind::kTwist;
  measurement.fields = {0, 1, 5};
  measurement.value[0] = speed_m_s;
  measurement.covariance = Matrix6d::Identity() * 1e-4;
  return measurement;
}

Measurement gyroAt(double time_s, double rate_rad_s) {
  Measurement measurement;
  measurement.channel = channel::kGyro;
  measurement.time_s = time_s;
  measurement.kind = Measurement::Kind::kRate;
  measurement.fields = {5};
  measurement.value[5] = rate_rad_s;
  measurement.covariance = Matrix6d::Identity() * 1e-6;
  return measurement;
}

std::vector<Measurement> someDrive() {
  std::vector<Measurement> drive;
  for (int i = 0; i < 100; ++i) {
    drive.push_back(wheelsAt(10.0 + 0.02 * i, 0.01 * i));
    drive.back().value[5] = 0.002 * i;
    drive.push_back(gyroAt(10.003 + 0.02 * i, 0.002 * i));
  }
  return drive;
}

TEST(FusionFilter, TheOrderOfArrivalDoesNotMatter) {
  const std::vector<Measurement> drive = someDrive();
  FusionFilter in_order = sceneFilter({}), mixed = sceneFilter({});
  for (const Measurement& measurement : drive) in_order.add(measurement, 12.1);
  std::vector<Measurement> late = drive;
  std::mt19937 random(3);
  // The first stays where it is: the filter begins with it.
  std::shuffle(late.begin() + 1, late.end(), random);
  for (const Measurement& measurement : late) mixed.add(measurement, 12.1);
  const FusedEstimate a = in_order.estimate(12.0), b = mixed.estimate(12.0);
  EXPECT_LT((a.T_world_base.matrix() - b.T_world_base.matrix()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((a.pose_covariance - b.pose_covariance).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(mixed.statistics()[channel::kGyro].rewound, 10u);
}

TEST(FusionFilter, TheHistoryIsBoundedInBytes) {
  FusionFilter filter = sceneFilter({});
  for (int i = 0; i < 20000; ++i) {
    filter.add(gyroAt(10.0 + 1e-4 * i, 0.0), 12.1);
    ASSERT_LE(filter.historyBytes(), 4'100'000u);
  }
}

TEST(FusionFilter, WhatComesLaterThanTheHistoryReachesIsCountedAndSaid) {
  FusionFilter filter = sceneFilter({});
  filter.add(gyroAt(10.0, 0.0), 10.0);
  filter.add(gyroAt(20.0, 0.0), 20.0);
  filter.add(gyroAt(15.0, 0.0), 20.1);
  EXPECT_EQ(filter.statistics()[channel::kGyro].too_late, 1u);
  EXPECT_EQ(filter.takeAnnouncements().size(), 1u);
}

TEST(FusionFilter, StampsOfTheFutureAreLeftOut) {
  FusionFilter filter = sceneFilter({});
  filter.add(gyroAt(10.0, 0.0), 10.0);
  filter.add(gyroAt(100.0, 0.0), 10.01);
  EXPECT_EQ(filter.time_s(), 10.0);
  EXPECT_EQ(filter.statistics()[channel::kGyro].ahead, 1u);
}

TEST(FusionFilter, FindsTheBiasOfTheGyroscopeAtRest) {
  FusionFilter filter = sceneFilter({});
  for (int i = 0; i < 500; ++i) {
    filter.add(gyroAt(10.0 + 0.02 * i, 0.003), 20.1);
    filter.add(wheelsAt(10.001 + 0.02 * i, 0.0), 20.1);
  }
  EXPECT_NEAR(filter.state().gyro_bias.z(), 0.003, 2e-4);
  EXPECT_LT(std::abs(logRotation(Eigen::Matrix3d(filter.state().T_world_base.linear())).z()), 0.003);
}

TEST(FusionFilter, SetPoseAndReset) {
  FusionFilter filter = sceneFilter({});
  filter.add(gyroAt(10.0, 0.0), 10.0);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << 3.0, -2.0, 0.0;
  filter.setPose(T, Matrix6d::Identity() * 0.04);
  EXPECT_NEAR(filter.estimate(10.0).T_world_base.translation().x(), 3.0, 1e-12);
  EXPECT_NEAR(filter.estimate(10.0).pose_covariance(1, 1), 0.04, 1e-9);
  filter.reset();
  EXPECT_FALSE(filter.started());
  filter.add(gyroAt(11.0, 0.0), 11.0);
  EXPECT_EQ(filter.estimate(11.0).T_world_base.translation().norm(), 0.0);
}

TEST(FusionFilter, OfTwoThatContradictEachOtherBothAreDoubtedAndNamed) {
  FusionFilter filter = sceneFilter({});
  std::vector<std::string> said;
  for (int i = 0; i < 100; ++i) {
    filter.add(wheelsAt(10.0 + 0.02 * i, 0.5), 12.1);
    filter.add(gyroAt(10.001 + 0.02 * i, i < 50 ? 0.0 : 0.5), 12.1);
    for (const std::string& text : filter.takeAnnouncements()) said.push_back(text);
  }
  EXPECT_TRUE(std::any_of(said.begin(), said.end(), [](const std::string& text) {
    return text.find("wheels and gyroscope disagree about vyaw") != std::string::npos;
  }));
}

}  // namespace
}  // namespace stereo_nav::estimation::test
