#include "stereo_nav/imu/attitude_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>

#include "stereo_nav/imu/emulation/motion.h"
#include "stereo_nav/imu/madgwick_filter.h"

namespace stereo_nav::imu {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180.0;
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

struct TiltAndYaw {
  double tilt_deg;
  double yaw_deg;
};

/// How far an estimate's horizon is tilted, and its heading turned, against the truth.
TiltAndYaw errorOf(const Quaterniond& estimate, const Quaterniond& truth) {
  const Quaterniond difference = estimate * truth.conjugate();  // in the world
  const Vector3d up = difference * Vector3d::UnitZ();
  const Vector3d x = difference * Vector3d::UnitX();
  return {std::acos(std::min(1.0, up.z())) / kDegree, std::atan2(x.y(), x.x()) / kDegree};
}

AttitudeParams paramsOf(AttitudeMethod method, bool magnetometer = false) {
  AttitudeParams params;
  params.method = method;
  params.use_magnetometer = magnetometer;
  return params;
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

/// Roll and pitch RMS at most 1 degree under the noise of the module; yaw drifts by nothing but the noise.
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

std::vector<std::vector<double>> readCsv(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string field;
    std::getline(fields, field, ',');
    std::vector<double> row = {static_cast<double>(std::stoll(field) % 1000000000000000LL) * 1e-9};
    while (std::getline(fields, field, ',')) row.push_back(std::stod(field));
    rows.push_back(row);
  }
  return rows;
}

struct Truth {
  double time_s;
  Vector3d p_world_m;
  Quaterniond q_world_imu;
};

struct Recording {
  std::vector<InertialSample> samples;
  std::vector<Truth> truth;

  double start_s() const { return truth.front().time_s; }
  /// Nothing more than 3 ms away.
  const Truth* truthAt(double time_s) const {
    const auto at = std::lower_bound(truth.begin(), truth.end(), time_s - 3e-3,
                                     [](const Truth& t, double wanted_s) { return t.time_s < wanted_s; });
    return at == truth.end() || at->time_s > time_s + 3e-3 ? nullptr : &*at;
  }
};

Recording readEuroc(const std::string& folder) {
  Recording recording;
  for (const auto& row : readCsv(folder + "/imu0/data.csv")) {
    InertialSample sample;
    sample.time_s = row.at(0);
    sample.angular_velocity << row.at(1), row.at(2), row.at(3);
    sample.linear_acceleration << row.at(4), row.at(5), row.at(6);
    recording.samples.push_back(sample);
  }
  for (const auto& row : readCsv(folder + "/state_groundtruth_estimate0/data.csv")) {
    recording.truth.push_back({row.at(0),
                               {row.at(1), row.at(2), row.at(3)},
                               Quaterniond(row.at(4), row.at(5), row.at(6), row.at(7)).normalized()});
  }
  return recording;
}

struct Offsets {
  Vector3d gyroscope = Vector3d::Zero();      ///< rad/s
  Vector3d accelerometer = Vector3d::Zero();  ///< m/s^2
};

/// Mean of measured minus true rate and acceleration over the first `duration_s` of the ground truth: what
/// calibrate_imu would have found, had the recording a part at rest and slow turns.
Offsets offsetsAtStart(const Recording& recording, double duration_s) {
  constexpr double kHalf_s = 0.05;
  Offsets sum;
  int count = 0;
  for (const InertialSample& sample : recording.samples) {
    const Truth* before = recording.truthAt(sample.time_s - kHalf_s);
    const Truth* now = recording.truthAt(sample.time_s);
    const Truth* after = recording.truthAt(sample.time_s + kHalf_s);
    if (before == nullptr || now == nullptr || after == nullptr) continue;
    if (sample.time_s > recording.start_s() + duration_s) break;
    const Eigen::AngleAxisd turn(before->q_world_imu.conjugate() * after->q_world_imu);
    sum.gyroscope += sample.angular_velocity - turn.axis() * turn.angle() / (2.0 * kHalf_s);
    const Vector3d acceleration =
        (after->p_world_m - 2.0 * now->p_world_m + before->p_world_m) / (kHalf_s * kHalf_s);
    sum.accelerometer +=
        sample.linear_acceleration -
        now->q_world_imu.conjugate() * (acceleration + Vector3d(0.0, 0.0, AttitudeFilter::kGravity_m_s2));
    ++count;
  }
  return {sum.gyroscope / count, sum.accelerometer / count};
}

struct FilterError {
  double tilt_rms_deg = 0.0;
  double yaw_change_deg = 0.0;
  int count = 0;
};

/// Of the filter's orientation from `start_s` on.
FilterError errorAgainstTruth(const Recording& recording, const Offsets& offsets, double start_s,
                              AttitudeMethod method) {
  const auto filter = makeAttitudeFilter(paramsOf(method));
  FilterError result;
  double squares = 0.0, yaw_start_deg = 0.0;
  for (InertialSample sample : recording.samples) {
    sample.angular_velocity -= offsets.gyroscope;
    sample.linear_acceleration -= offsets.accelerometer;
    filter->update(sample);
    const Truth* truth = recording.truthAt(sample.time_s);
    if (truth == nullptr || sample.time_s < start_s) continue;
    const TiltAndYaw error = errorOf(filter->q_world_imu(), truth->q_world_imu);
    if (result.count++ == 0) yaw_start_deg = error.yaw_deg;
    result.yaw_change_deg = wrapDegrees(error.yaw_deg - yaw_start_deg);
    squares += error.tilt_deg * error.tilt_deg;
  }
  result.tilt_rms_deg = std::sqrt(squares / result.count);
  return result;
}

/// EuRoC MH_01: an industrial IMU on a rig that is swung about, against ground truth. Its gyroscope is off by
/// 4.5 deg/s and its accelerometer by 0.14 m/s^2. What a calibration would have found is taken from the first
/// 3 s, and only the other 8 s are judged.
TEST_P(BothFilters, FollowTheGroundTruthOfARealRecording) {
  const char* data = std::getenv("STEREO_NAV_DATA");
  if (data == nullptr) GTEST_SKIP() << "STEREO_NAV_DATA is not set";
  const Recording recording = readEuroc(std::string(data) + "/euroc_mh01_a");
  ASSERT_GT(recording.samples.size(), 2000U);
  ASSERT_GT(recording.truth.size(), 2000U);
  const double calibration_s = 3.0;
  const Offsets calibrated = offsetsAtStart(recording, calibration_s);
  const Offsets gyroscope_only{calibrated.gyroscope, Vector3d::Zero()};
  const auto errorWith = [&](const Offsets& offsets) {
    const FilterError error =
        errorAgainstTruth(recording, offsets, recording.start_s() + calibration_s, GetParam());
    std::cout << "EuRoC MH_01, gyroscope off by " << offsets.gyroscope.transpose()
              << " rad/s, accelerometer by " << offsets.accelerometer.transpose() << " m/s^2: tilt RMS "
              << error.tilt_rms_deg << " deg, yaw change against truth " << error.yaw_change_deg << " deg\n";
    return error;
  };
  const FilterError error = errorWith(calibrated);
  EXPECT_GT(error.count, 1500);
  EXPECT_LT(error.tilt_rms_deg, 1.0);
  EXPECT_LT(std::abs(error.yaw_change_deg), 2.0);
  EXPECT_LT(errorWith(gyroscope_only).tilt_rms_deg, 2.0);
}

}  // namespace
}  // namespace stereo_nav::imu
