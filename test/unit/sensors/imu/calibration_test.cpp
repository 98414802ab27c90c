#include "stereo_nav/sensors/imu/calibration.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <random>

#include "sensors/imu/emulation/motion.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::imu {
namespace {

using Eigen::Vector3d;

class Noise {
 public:
  Vector3d operator()(double stddev) {
    return {stddev * normal_(random_), stddev * normal_(random_), stddev * normal_(random_)};
  }

 private:
  std::mt19937 random_{9};
  std::normal_distribution<double> normal_;
};

const Vector3d kBias(0.01, -0.02, 0.03);
const Vector3d kGravity(0.0, 0.0, 9.80665);

/// 16 s at 100 Hz; `rate` is what really turns the module at a time.
template <class Rate>
GyroCalibrator::Result calibrate(Rate rate) {
  GyroCalibrator calibrator({});
  Noise noise;
  for (int k = 0; k < 1600; ++k) {
    calibrator.add(0.01 * k, kBias + rate(0.01 * k) + noise(0.002), kGravity + noise(0.05));
  }
  return calibrator.result();
}

TEST(GyroCalibrator, FindsTheBiasAtRest) {
  const auto result = calibrate([](double) { return Vector3d::Zero(); });
  ASSERT_TRUE(result.accepted) << result.message;
  EXPECT_LT((result.bias - kBias).norm(), 3e-4);
  EXPECT_NEAR(result.stddev.x(), 0.002, 3e-4);
}

TEST(GyroCalibrator, RefusesAShake) {
  const auto result = calibrate([](double t) { return Vector3d(0, 0, t > 8.0 && t < 8.5 ? 0.3 : 0.0); });
  EXPECT_FALSE(result.accepted);
  EXPECT_NE(result.message.find("the module moved"), std::string::npos);
}

TEST(GyroCalibrator, RefusesASlowTurnThatBegins) {
  EXPECT_FALSE(calibrate([](double t) { return Vector3d(0, 0, t > 8.0 ? 0.03 : 0.0); }).accepted);
}

TEST(GyroCalibrator, RefusesASteadyTurn) {
  EXPECT_FALSE(calibrate([](double) { return Vector3d(0, 0, 0.5); }).accepted);
}

TEST(GyroCalibrator, RefusesAJoltWithoutTurning) {
  GyroCalibrator calibrator({});
  for (int k = 0; k < 1600; ++k) {
    calibrator.add(0.01 * k, kBias, kGravity + Vector3d(k % 2 == 0 ? 0.5 : -0.5, 0, 0));
  }
  EXPECT_FALSE(calibrator.result().accepted);
}

TEST(GyroCalibrator, RefusesAStreamThatEnded) {
  GyroCalibrator calibrator({});
  for (int k = 0; k < 200; ++k) calibrator.add(0.01 * k, kBias, kGravity);
  EXPECT_FALSE(calibrator.complete());
  EXPECT_FALSE(calibrator.result().accepted);
}

const Vector3d kOffset(0.3, -0.5, 0.8);
const Vector3d kGain(1.03, 0.97, 1.01);

std::vector<Vector3d> measuredDuring(const Motion& motion, double duration_s, double noise_stddev) {
  Noise noise;
  std::vector<Vector3d> points;
  for (double t = 0.0; t < duration_s; t += 0.01) {
    points.push_back(motion(t).linear_acceleration.cwiseProduct(kGain) + kOffset + noise(noise_stddev));
  }
  return points;
}

TEST(SphereFit, FindsOffsetAndScaleFromSlowTurns) {
  const SphereFit fit = fitSphere(measuredDuring(slowTurns(), 36.0, 0.0), 9.80665);
  ASSERT_TRUE(fit.accepted) << fit.message;
  EXPECT_LT((fit.offset - kOffset).norm(), 1e-9);
  EXPECT_LT((fit.scale - kGain.cwiseInverse()).norm(), 1e-9);
}

TEST(SphereFit, StandsTheNoiseOfTheModule) {
  const SphereFit fit = fitSphere(measuredDuring(slowTurns(), 36.0, 0.05), 9.80665);
  ASSERT_TRUE(fit.accepted) << fit.message;
  EXPECT_LT((fit.offset - kOffset).norm(), 0.01);
  EXPECT_LT((fit.scale - kGain.cwiseInverse()).norm(), 1e-3);
  EXPECT_NEAR(fit.residual_rms, 0.05, 0.01);
}

TEST(SphereFit, RefusesTurnsAboutOneAxisOnlyAndNamesTheRemedy) {
  const SphereFit fit = fitSphere(measuredDuring(slowTurns(), 12.0, 0.05), 9.80665);
  EXPECT_FALSE(fit.accepted);
  EXPECT_NE(fit.message.find("turn"), std::string::npos);
}

TEST(SphereFit, RefusesHastyTurns) {
  const SphereFit fit = fitSphere(measuredDuring(slowTurns(), 36.0, 2.0), 9.80665);
  EXPECT_FALSE(fit.accepted);
}

TEST(SphereFit, RefusesTooFewOrNoPoints) {
  EXPECT_FALSE(fitSphere({}, 9.80665).accepted);
}

TEST(ImuCalibration, IsAppliedPerAxis) {
  ImuCalibration calibration;
  calibration.gyroscope_bias.value = kBias;
  calibration.accelerometer_offset.value = kOffset;
  calibration.accelerometer_scale.value = kGain.cwiseInverse();
  RawMeasurement measured;
  measured.angular_velocity = Vector3d(1.0, 2.0, 3.0) + kBias;
  measured.linear_acceleration = kGravity.cwiseProduct(kGain) + kOffset;
  const InertialSample sample = calibration.apply(measured, 7.0);
  EXPECT_EQ(sample.time_s, 7.0);
  EXPECT_LT((sample.angular_velocity - Vector3d(1.0, 2.0, 3.0)).norm(), 1e-12);
  EXPECT_LT((sample.linear_acceleration - kGravity).norm(), 1e-12);
  EXPECT_FALSE(sample.magnetic_field.has_value());
}

TEST(ImuCalibration, SurvivesItsFile) {
  const auto path =
      std::filesystem::temp_directory_path() / ("imu_calibration_" + std::to_string(getpid()) + ".yaml");
  ImuCalibration calibration;
  calibration.gyroscope_bias.value = kBias;
  calibration.magnetometer_offset.value << 1.0, 2.0, 3.0;
  saveCalibration(calibration, path.string());
  const ImuCalibration read = loadCalibration(path.string());
  std::filesystem::remove(path);
  EXPECT_LT((read.gyroscope_bias.value - kBias).norm(), 1e-9);
  EXPECT_EQ(read.magnetometer_offset.value, Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(read.accelerometer_scale.value, Vector3d::Ones());
}

TEST(ImuCalibration, AnUnwritableFileIsAnErrorThatNamesIt) {
  EXPECT_THROW(saveCalibration({}, "/nonexistent/folder/imu.yaml"), std::runtime_error);
  EXPECT_THROW(loadCalibration("/nonexistent/folder/imu.yaml"), ParameterError);
}

}  // namespace
}  // namespace stereo_nav::imu
