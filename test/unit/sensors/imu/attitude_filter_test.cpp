#include "stereo_nav/sensors/imu/attitude_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "sensors/imu/emulation/motion.h"
#include "sensors/imu/madgwick_filter.h"
#include "unit/sensors/imu/attitude_error.h"

namespace stereo_nav::imu {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kDt_s = 0.005;

struct SensorErrors {
  Vector3d gyro_bias = Vector3d::Zero();
  double gyro_noise = 0.0;
  double accelerometer_noise = 0.0;
};

/// MPU6050 by its data sheet: 0.005 deg/s/sqrt(Hz) and 400 ug/sqrt(Hz), at 200 Hz.
const SensorErrors kMpu6050{Vector3d::Zero(), 0.005 * kDegree * 10.0, 400e-6 * 9.81 * 10.0};

InertialSample sampleOf(const MotionState& state, double time_s, const SensorErrors& errors,
                        std::mt19937& random) {
  std::normal_distribution<double> normal;
  const auto noise = [&](double stddev) {
    return Vector3d(stddev * normal(random), stddev * normal(random), stddev * normal(random));
  };
  InertialSample sample;
  sample.time_s = time_s;
  sample.angular_velocity = state.angular_velocity + errors.gyro_bias + noise(errors.gyro_noise);
  sample.linear_acceleration = state.linear_acceleration + noise(errors.accelerometer_noise);
  sample.magnetic_field = state.q_world_imu.conjugate() * Vector3d(0.0, 20.0, -44.0);
  return sample;
}

class BothFilters : public testing::TestWithParam<AttitudeMethod> {};
INSTANTIATE_TEST_SUITE_P(Attitude, BothFilters,
                         testing::Values(AttitudeMethod::kMahony, AttitudeMethod::kMadgwick));

TEST_P(BothFilters, StartLevelWithHeadingZero) {
  const auto filter = makeAttitudeFilter(paramsOf(GetParam()));
  EXPECT_FALSE(filter->initialised());
  std::mt19937 random(1);
  const Quaterniond truth = orientationFromModule({0.0, 12.0, -7.0});
  filter->update(
      sampleOf({truth, Vector3d::Zero(), truth.conjugate() * Vector3d(0, 0, 9.80665)}, 0.0, {}, random));
  ASSERT_TRUE(filter->initialised());
  EXPECT_LT(filter->q_world_imu().angularDistance(truth), 1e-9);
}

TEST_P(BothFilters, StartTowardsTheMagneticNorth) {
  const auto filter = makeAttitudeFilter(paramsOf(GetParam(), true));
  std::mt19937 random(1);
  const Quaterniond truth = orientationFromModule({-130.0, 12.0, -7.0});
  filter->update(
      sampleOf({truth, Vector3d::Zero(), truth.conjugate() * Vector3d(0, 0, 9.80665)}, 0.0, {}, random));
  EXPECT_LT(filter->q_world_imu().angularDistance(truth), 1e-9);
}

TEST_P(BothFilters, IntegrateATurnToItsAngle) {
  const auto filter = makeAttitudeFilter(paramsOf(GetParam()));
  const Motion motion = constantRates({0, 0, 0}, {-45.0, 0, 0});
  std::mt19937 random(1);
  for (int k = 0; k <= 400; ++k) filter->update(sampleOf(motion(kDt_s * k), kDt_s * k, {}, random));
  EXPECT_NEAR(heading(filter->q_world_imu()) / kDegree, 90.0, 1e-2);
}

/// Roll and pitch RMS at most 1 degree under the noise of the module; yaw drifts by the noise only.
TEST_P(BothFilters, HoldTheHorizonOnASwayingRobot) {
  const auto filter = makeAttitudeFilter(paramsOf(GetParam()));
  const Motion motion = swaying();
  std::mt19937 random(2);
  double squares = 0.0;
  int count = 0;
  TiltAndYaw first{}, last{};
  for (int k = 0; k < 60000; ++k) {
    const MotionState state = motion(kDt_s * k);
    filter->update(sampleOf(state, kDt_s * k, kMpu6050, random));
    last = errorOf(filter->q_world_imu(), state.q_world_imu);
    if (k == 0) first = last;
    squares += last.tilt_deg * last.tilt_deg;
    ++count;
  }
  const double rms = std::sqrt(squares / count);
  std::printf("swaying, MPU6050 noise, 300 s: tilt RMS %.3f deg, yaw drift %.3f deg\n", rms,
              last.yaw_deg - first.yaw_deg);
  EXPECT_LE(rms, 1.0);
  EXPECT_LE(std::abs(last.yaw_deg - first.yaw_deg), 1.0);
}

/// The same robot while it drives at up to 0.9 m/s: it accelerates, brakes, and senses the lateral
/// acceleration of its curves.
TEST_P(BothFilters, HoldTheHorizonOfADrivingRobot) {
  const auto filter = makeAttitudeFilter(paramsOf(GetParam()));
  const Motion motion = swaying();
  std::mt19937 random(2);
  double squares = 0.0;
  constexpr int kCount = 60000;
  for (int k = 0; k < kCount; ++k) {
    const double t = kDt_s * k;
    MotionState state = motion(t);
    const double speed_m_s = 0.5 + 0.4 * std::sin(0.9 * t);
    state.linear_acceleration +=
        Vector3d(0.36 * std::cos(0.9 * t), speed_m_s * state.angular_velocity.z(), 0.0);
    filter->update(sampleOf(state, t, kMpu6050, random));
    const double tilt_deg = errorOf(filter->q_world_imu(), state.q_world_imu).tilt_deg;
    squares += tilt_deg * tilt_deg;
  }
  const double rms_deg = std::sqrt(squares / kCount);
  std::printf("driving at up to 0.9 m/s, 300 s: tilt RMS %.3f deg\n", rms_deg);
  EXPECT_LE(rms_deg, 1.0);
}

TEST_P(BothFilters, DriftInYawByTheRemainingBias) {
  for (const double bias_deg_s : {0.02, -0.05}) {
    const auto filter = makeAttitudeFilter(paramsOf(GetParam()));
    SensorErrors errors = kMpu6050;
    errors.gyro_bias.z() = bias_deg_s * kDegree;
    std::mt19937 random(3);
    const MotionState rest = constantRates({0, 0, 0}, {})(0.0);
    TiltAndYaw error{};
    const int count = 40000;
    for (int k = 0; k <= count; ++k) {
      filter->update(sampleOf(rest, kDt_s * k, errors, random));
      error = errorOf(filter->q_world_imu(), rest.q_world_imu);
    }
    const double expected_deg = bias_deg_s * kDt_s * count;
    std::printf("rest, yaw bias %.2f deg/s, 200 s: yaw drift %.2f deg, expected %.2f\n", bias_deg_s,
                error.yaw_deg, expected_deg);
    EXPECT_NEAR(error.yaw_deg, expected_deg, 0.2 + 0.02 * std::abs(expected_deg));
  }
}

TEST_P(BothFilters, FindTheBiasOfTheLevelAxes) {
  const auto filter = makeAttitudeFilter(paramsOf(GetParam()));
  SensorErrors errors = kMpu6050;
  errors.gyro_bias << 0.5 * kDegree, -0.3 * kDegree, 0.0;
  std::mt19937 random(4);
  const MotionState rest = constantRates({0, 0, 0}, {})(0.0);
  for (int k = 0; k < 60000; ++k) filter->update(sampleOf(rest, kDt_s * k, errors, random));
  EXPECT_LT((filter->gyroBias() - errors.gyro_bias).norm(), 0.1 * kDegree);
  EXPECT_LT(errorOf(filter->q_world_imu(), rest.q_world_imu).tilt_deg, 0.5);
}

TEST_P(BothFilters, HoldTheHeadingWithAMagnetometer) {
  const auto filter = makeAttitudeFilter(paramsOf(GetParam(), true));
  SensorErrors errors = kMpu6050;
  errors.gyro_bias.z() = 0.2 * kDegree;
  const Motion motion = swaying();
  std::mt19937 random(5);
  double worst = 0.0;
  for (int k = 0; k < 60000; ++k) {
    const MotionState state = motion(kDt_s * k);
    filter->update(sampleOf(state, kDt_s * k, errors, random));
    if (k > 20000)
      worst = std::max(worst, std::abs(errorOf(filter->q_world_imu(), state.q_world_imu).yaw_deg));
  }
  EXPECT_LT(worst, 2.0);
}

TEST_P(BothFilters, IgnoreTheAccelerometerWhileTheRobotAccelerates) {
  const auto filter = makeAttitudeFilter(paramsOf(GetParam()));
  std::mt19937 random(6);
  MotionState state = constantRates({0, 0, 0}, {})(0.0);
  filter->update(sampleOf(state, 0.0, {}, random));
  state.linear_acceleration.x() = 6.0;
  for (int k = 1; k < 400; ++k) filter->update(sampleOf(state, kDt_s * k, {}, random));
  EXPECT_LT(errorOf(filter->q_world_imu(), Quaterniond::Identity()).tilt_deg, 1e-6);
}

TEST_P(BothFilters, KeepTheHeadingOverAGapAndIgnoreOldSamples) {
  const auto filter = makeAttitudeFilter(paramsOf(GetParam()));
  const Motion motion = constantRates({0, 0, 0}, {-45.0, 0, 0});
  std::mt19937 random(7);
  for (int k = 0; k <= 400; ++k) filter->update(sampleOf(motion(kDt_s * k), kDt_s * k, {}, random));
  EXPECT_FALSE(filter->update(sampleOf(motion(1.0), 1.0, {}, random)));
  filter->update(sampleOf(constantRates({0, 10.0, 0}, {})(0.0), 60.0, {}, random));
  EXPECT_NEAR(heading(filter->q_world_imu()) / kDegree, 90.0, 0.1);
  EXPECT_NEAR(errorOf(filter->q_world_imu(), Quaterniond::Identity()).tilt_deg, 10.0, 0.1);
}

TEST(Madgwick, GradientEqualsNumericDifferences) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::Vector4d q(uniform(random), uniform(random), uniform(random), uniform(random));
    q.normalize();
    const Vector3d up = Vector3d(uniform(random), uniform(random), uniform(random)).normalized();
    const Vector3d field = Vector3d(uniform(random), uniform(random), uniform(random)).normalized();
    const Vector3d reference = Vector3d(0.0, 0.4, -0.9).normalized();
    const Eigen::Vector4d gradient = MadgwickFilter::gradient(q, &up, &field, reference);
    for (int i = 0; i < 4; ++i) {
      Eigen::Vector4d plus = q, minus = q;
      plus[i] += 1e-6;
      minus[i] -= 1e-6;
      const double numeric = (MadgwickFilter::objective(plus, &up, &field, reference) -
                              MadgwickFilter::objective(minus, &up, &field, reference)) /
                             2e-6;
      ASSERT_NEAR(gradient[i], numeric, 1e-6);
    }
  }
}

}  // namespace
}  // namespace stereo_nav::imu
