#include "estimation/range_correction/range_corrector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "grid/ray_cast.h"
#include "hall_map.h"

namespace stereo_nav::estimation::test {
namespace {

constexpr double kNees95 = 7.815;

Eigen::Isometry2d pose(double x, double y, double yaw) {
  Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
  T.translation() << x, y;
  T.linear() = Eigen::Rotation2Dd(yaw).toRotationMatrix();
  return T;
}

/// Range finders 0.2 m before, behind, left and right of the middle.
Eigen::Isometry2d mounting(std::size_t sensor) {
  const double yaw = 0.5 * kPi * static_cast<double>(sensor);
  return pose(0.2 * std::cos(yaw), 0.2 * std::sin(yaw), yaw);
}

/// A drive in the hall: rounds with turns on the spot between them.
struct Drive {
  unsigned seed = 1;
  grid::OccupancyGrid known = hallMap();  ///< the map that the robot has
  double largest_bias_m = 0.05;
  /// What a beam of length `range_m` meets instead.
  std::function<double(std::size_t sensor, double time_s, double range_m)> foreign;
};

struct Errors {
  double position_m2 = 0.0, yaw_rad2 = 0.0, nees = 0.0, largest_m = 0.0;
  int inside_95 = 0, count = 0;
  std::array<std::size_t, kRangeOutcomes> outcomes{};

  void add(const Eigen::Isometry2d& T_true, const RangeCorrector& corrector) {
    Eigen::Vector3d error;
    error << corrector.T_map_base().translation() - T_true.translation(),
        Eigen::Rotation2Dd(T_true.linear().transpose() * corrector.T_map_base().linear()).angle();
    const double own_nees = error.dot(corrector.covariance().ldlt().solve(error));
    position_m2 += error.head<2>().squaredNorm();
    largest_m = std::max(largest_m, error.head<2>().norm());
    yaw_rad2 += error[2] * error[2];
    nees += own_nees;
    inside_95 += own_nees < kNees95 ? 1 : 0;
    ++count;
  }
  double rms_m() const { return std::sqrt(position_m2 / count); }
};

void run(const Drive& drive, Errors& errors) {
  std::mt19937 random(drive.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const grid::OccupancyGrid hall = hallMap();
  RangeParams params;
  params.reading_sigma_m = 0.01;
  RangeCorrector corrector(params, 4);
  corrector.setMap(drive.known);
  double biases[4];
  for (double& bias : biases) bias = drive.largest_bias_m * uniform(random);
  Eigen::Isometry2d T_true = pose(2.0, 1.2, 0.0), T_odom = Eigen::Isometry2d::Identity();
  corrector.setPose(T_true * expPlanar({0.1 * normal(random), 0.1 * normal(random), 0.03 * normal(random)}),
                    Eigen::Vector3d(0.01, 0.01, 0.0009).asDiagonal());
  const double step_s = 0.05;
  for (int i = 0; i < 2400; ++i) {
    const double t = i * step_s;
    const Eigen::Vector3d motion = step_s * Eigen::Vector3d(0.35, 0.0, 0.3 + 0.12 * std::sin(0.13 * t));
    T_true = T_true * expPlanar(motion);
    const double way = std::sqrt(motion[0]), turn = std::sqrt(motion[0] + std::abs(motion[2]));
    T_odom =
        T_odom * expPlanar(motion + Eigen::Vector3d(0.02 * way * normal(random), 0.02 * way * normal(random),
                                                    0.02 * turn * normal(random)));
    for (std::size_t sensor = 0; sensor < 4; ++sensor) {
      const Eigen::Isometry2d T_map_sensor = T_true * mounting(sensor);
      double range_m = grid::castRay(hall, T_map_sensor.translation(),
                                     Eigen::Rotation2Dd(T_map_sensor.linear()).angle(), 12.0)
                           .distance_m;
      if (drive.foreign) range_m = drive.foreign(sensor, t, range_m);
      RangeReading reading;
      reading.sensor = sensor;
      reading.time_s = t;
      reading.T_base_sensor = mounting(sensor);
      reading.half_width_rad = 0.0314;
      reading.range_m = range_m + biases[sensor] + 0.01 * normal(random);
      corrector.add(reading, T_odom);
    }
    if (t > 30.0 && i % 20 == 0) errors.add(T_true, corrector);
  }
  for (std::size_t i = 0; i < kRangeOutcomes; ++i)
    errors.outcomes[i] += corrector.count(static_cast<RangeOutcome>(i));
}

Errors runAll(Drive drive, unsigned runs) {
  Errors errors;
  for (drive.seed = 1; drive.seed <= runs; ++drive.seed) run(drive, errors);
  return errors;
}

RangeReading readingOf(std::size_t sensor, double time_s, double range_m) {
  RangeReading reading;
  reading.sensor = sensor;
  reading.time_s = time_s;
  reading.T_base_sensor = mounting(sensor);
  reading.half_width_rad = 0.0314;
  reading.range_m = range_m;
  return reading;
}

TEST(RangeCorrector, AtRestTheWallsGiveThePlace) {
  RangeParams params;
  params.bias_sigma_m = 0.001;
  RangeCorrector corrector(params, 4);
  corrector.setMap(hallMap());
  corrector.setPose(pose(2.1, 1.9, 0.0), Eigen::Vector3d(0.01, 0.01, 1e-6).asDiagonal());
  const double ranges[4] = {5.8, 2.8, 1.8, 1.8};  // at (2, 2)
  for (int i = 0; i < params.readings; ++i)
    for (std::size_t sensor = 0; sensor < 4; ++sensor)
      corrector.add(readingOf(sensor, 0.1 * i, ranges[sensor]), Eigen::Isometry2d::Identity());
  EXPECT_NEAR((corrector.T_map_base().translation() - Eigen::Vector2d(2.0, 2.0)).norm(), 0.0, 0.003);
  EXPECT_EQ(corrector.count(RangeOutcome::kUsed), 4u);
}

TEST(RangeCorrector, AtRestEachRangeFinderCountsOnce) {
  RangeCorrector corrector(RangeParams(), 1);
  corrector.setMap(hallMap());
  corrector.setPose(pose(2.0, 2.0, 0.0), Eigen::Vector3d(0.01, 0.01, 1e-6).asDiagonal());
  for (int i = 0; i < 100; ++i) corrector.add(readingOf(0, 0.1 * i, 5.8), Eigen::Isometry2d::Identity());
  EXPECT_EQ(corrector.count(RangeOutcome::kUsed), 1u);
}

TEST(RangeCorrector, OfTwoWallsThatABeamMayMeanTheRightOneIsTakenOrNone) {
  // Beside the pillar's edge: it is 2.8 m ahead, the wall behind it 5.8 m.
  const auto after = [](double range_m) {
    RangeCorrector corrector(RangeParams(), 1);
    corrector.setMap(hallMap());
    corrector.setPose(pose(2.0, 3.0, 0.0), Eigen::Vector3d(0.0025, 0.0025, 1e-4).asDiagonal());
    RangeOutcome outcome = RangeOutcome::kWaiting;
    for (int i = 0; i < RangeParams().readings; ++i)
      outcome = corrector.add(readingOf(0, 0.1 * i, range_m), Eigen::Isometry2d::Identity());
    return std::make_pair(outcome, corrector.T_map_base().translation().x());
  };
  EXPECT_EQ(after(2.75).first, RangeOutcome::kUsed);
  EXPECT_GT(after(2.75).second, 2.02);
  EXPECT_EQ(after(5.85).first, RangeOutcome::kUsed);
  EXPECT_LT(after(5.85).second, 1.98);
  EXPECT_EQ(after(4.0).first, RangeOutcome::kForeign);
  EXPECT_EQ(after(4.0).second, 2.0);
}

TEST(RangeCorrector, WhatTwoWallsExplainEquallyIsLeftOut) {
  // A pose so uncertain that either wall may be meant.
  RangeCorrector corrector(RangeParams(), 1);
  corrector.setMap(hallMap());
  corrector.setPose(pose(2.0, 3.0, 0.0), Eigen::Vector3d(4.0, 0.01, 1e-4).asDiagonal());
  RangeOutcome outcome = RangeOutcome::kWaiting;
  for (int i = 0; i < RangeParams().readings; ++i)
    outcome = corrector.add(readingOf(0, 0.1 * i, 4.3), Eigen::Isometry2d::Identity());
  EXPECT_EQ(outcome, RangeOutcome::kAmbiguous);
  EXPECT_EQ(corrector.T_map_base().translation().x(), 2.0);
}

TEST(RangeCorrector, BiasedRangeFindersGiveThePlaceWithin2Centimetres) {
  const Errors errors = runAll({}, 20);
  EXPECT_LE(errors.rms_m(), 0.02);
  EXPECT_GT(errors.nees / errors.count, 1.5);
  EXPECT_LT(errors.nees / errors.count, 5.0);
  EXPECT_GT(errors.inside_95, 0.85 * errors.count);
}

TEST(RangeCorrector, WhatTheMapDoesNotHaveIsLeftOut) {
  Drive drive;
  // People: for a third of the time something stands before each range finder.
  drive.foreign = [](std::size_t sensor, double t, double range_m) {
    const double phase = std::fmod(t + 2.3 * static_cast<double>(sensor), 9.0);
    return phase < 3.0 ? std::min(range_m, 0.4 + 0.3 * phase) : range_m;
  };
  const Errors errors = runAll(drive, 20);
  EXPECT_LE(errors.rms_m(), 0.03);
  EXPECT_GT(errors.outcomes[static_cast<std::size_t>(RangeOutcome::kForeign)], 1000u);
}

TEST(RangeCorrector, AFinderWhoseConeMeetsTheFloorMisleadsNobody) {
  Drive drive;
  // The one ahead sees nothing beyond 2.5 m: the floor, which moves with the robot.
  drive.foreign = [](std::size_t sensor, double, double range_m) {
    return sensor == 0 ? std::min(range_m, 2.5) : range_m;
  };
  const Errors errors = runAll(drive, 20);
  EXPECT_LE(errors.rms_m(), 0.03);
  EXPECT_LT(errors.nees / errors.count, 5.0);
  EXPECT_GT(errors.inside_95, 0.85 * errors.count);
}

TEST(RangeCorrector, AWallThatComesNearerUnlikeTheRobotIsNotMeant) {
  // At (2, 2) the wall is 5.8 m ahead. The pose is uncertain by 0.5 m, so that 5.5 m may be that wall; but
  // the reading does not change while the robot drives 0.4 m.
  const auto used = [](double change_m) {
    RangeCorrector corrector(RangeParams(), 1);
    corrector.setMap(hallMap());
    corrector.setPose(pose(2.0, 2.0, 0.0), Eigen::Vector3d(0.25, 0.01, 1e-6).asDiagonal());
    RangeOutcome outcome = RangeOutcome::kWaiting;
    for (int i = 0; i < RangeParams().readings; ++i)
      outcome = corrector.add(readingOf(0, 0.1 * i, 5.5 - i * change_m), pose(0.1 * i, 0.0, 0.0));
    return outcome == RangeOutcome::kUsed;
  };
  EXPECT_TRUE(used(0.1));
  EXPECT_FALSE(used(0.0));
}

TEST(RangeCorrector, ThePlaceBecomesAsUncertainAsTheOdometrySays) {
  // The robot heads along y of the map, its odometry along x.
  RangeCorrector corrector(RangeParams(), 1);
  corrector.setMap(hallMap());
  corrector.setPose(pose(2.0, 2.0, 0.5 * kPi), Eigen::Vector3d(0.01, 0.01, 1e-8).asDiagonal());
  corrector.add(readingOf(0, 0.0, 3.0), pose(0.0, 0.0, 0.0), Eigen::Vector3d(0.1, 0.1, 0.0).asDiagonal());
  corrector.add(readingOf(0, 0.1, 2.0), pose(1.0, 0.0, 0.0), Eigen::Vector3d(0.6, 0.1, 0.0).asDiagonal());
  const double by_parameters = std::pow(RangeParams().way_noise_m, 2);
  EXPECT_NEAR(corrector.covariance()(1, 1), 0.01 + 0.5, 1e-6);
  EXPECT_NEAR(corrector.covariance()(0, 0), 0.01 + by_parameters, 1e-6);
  // A covariance that becomes smaller takes nothing back.
  corrector.add(readingOf(0, 0.2, 2.0), pose(1.0, 0.0, 0.0), Eigen::Matrix3d::Zero());
  EXPECT_NEAR(corrector.covariance()(1, 1), 0.01 + 0.5, 1e-6);
}

TEST(RangeCorrector, AWallThatIsElsewhereIsGated) {
  Drive drive;
  // The map has the upper wall 0.6 m too low.
  for (int y = 90; y < 102; ++y)
    for (int x = 0; x < 164; ++x) drive.known.at({x, y}) = grid::kOccupied;
  const Errors errors = runAll(drive, 20);
  EXPECT_LE(errors.rms_m(), 0.03);
}

}  // namespace
}  // namespace stereo_nav::estimation::test
