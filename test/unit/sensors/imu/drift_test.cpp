#include "sensors/imu/drift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "core/angles.h"
#include "sensors/imu/allan_deviation.h"
#include "sensors/imu/imu_estimator.h"

namespace stereo_nav::imu {
namespace {

TEST(Drift, IsThatOfTheThesisModuleAcrossTheWrap) {
  std::vector<AngleSample> samples;
  for (int k = 0; k <= 6000; ++k) {
    const double t = 0.1 * k;
    samples.push_back({t, {wrapDegrees(178.0 + 2.9 * t / 600.0), 0.5 * std::sin(t), -1.0}});
  }
  const DriftReport drift = measureDrift(samples);
  EXPECT_NEAR(drift.duration_s, 600.0, 1e-6);
  EXPECT_NEAR(drift.yaw.total_deg, 2.9, 0.01);
  EXPECT_NEAR(drift.yaw.slope_deg_min, 0.29, 1e-6);
  EXPECT_NEAR(drift.yaw.residual_deg, 0.0, 1e-5);
  EXPECT_NEAR(drift.pitch.residual_deg, 0.5 / std::sqrt(2.0), 0.01);
  EXPECT_NEAR(drift.roll.largest_deg, 0.0, 1e-9);
}

TEST(Drift, RefusesTooShortARecording) {
  EXPECT_THROW(measureDrift({}), std::invalid_argument);
  EXPECT_THROW(measureDrift({{0.0, {}}, {1.0, {}}}), std::invalid_argument);
}

TEST(AllanDeviation, OfWhiteNoiseFallsWithTheRootOfTime) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, 0.1);  // at 100 Hz: density 0.01
  std::vector<double> samples;
  for (int i = 0; i < 60000; ++i) samples.push_back(normal(random));
  const auto points = allanDeviation(samples, 0.01);
  EXPECT_NEAR(noiseDensity(points), 0.01, 2e-4);
  for (const AllanPoint& point : points) {
    if (point.tau_s < 10.0) {
      EXPECT_NEAR(point.deviation * std::sqrt(point.tau_s), 0.01, 0.0015);
    }
  }
}

TEST(AllanDeviation, OfARandomWalkGrowsWithTheRootOfTime) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal(0.0, 0.002 * std::sqrt(0.01));  // K = 0.002
  std::vector<double> samples = {0.0};
  for (int i = 0; i < 200000; ++i) samples.push_back(samples.back() + normal(random));
  for (const AllanPoint& point : allanDeviation(samples, 0.01)) {
    if (point.tau_s > 1.0 && point.tau_s < 10.0) {
      EXPECT_NEAR(point.deviation / std::sqrt(point.tau_s / 3.0), 0.002, 0.0005);
    }
  }
}

TEST(AllanDeviation, NeedsSamples) {
  EXPECT_TRUE(allanDeviation({}, 0.01).empty());
  EXPECT_TRUE(std::isnan(noiseDensity({})));
  EXPECT_TRUE(std::isnan(biasInstability({})));
}

TEST(ImuEstimator, ResetsTheYawOfAnglesAndKeepsTheTilt) {
  ImuEstimator estimator({}, {}, 0.02);
  ImuReading reading;
  reading.angles = ModuleAngles{40.0, 5.0, 3.0};
  reading.time_s = 1.0;
  estimator.process(reading);
  estimator.resetYaw();
  reading.time_s = 1.01;
  const Eigen::Quaterniond q = estimator.process(reading).q_world_imu.value();
  EXPECT_NEAR(heading(q), 0.0, 1e-9);
  EXPECT_NEAR(moduleFromOrientation(q).pitch_deg, 5.0, 1e-9);
}

TEST(ImuEstimator, TakesTheBiasOffRawRates) {
  ImuEstimator estimator({}, {}, 0.02);
  const Eigen::Vector3d bias(0.01, 0.02, -0.03);
  estimator.setGyroBias(bias);
  ImuReading reading;
  reading.raw.emplace();
  reading.raw->angular_velocity = bias;
  reading.raw->linear_acceleration << 0.0, 0.0, 9.80665;
  const ImuEstimate estimate = estimator.process(reading);
  EXPECT_LT(estimate.angular_velocity.value().norm(), 1e-12);
  EXPECT_TRUE(estimate.q_world_imu.has_value());
}

}  // namespace
}  // namespace stereo_nav::imu
