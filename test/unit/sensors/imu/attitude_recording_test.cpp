// The attitude filters on a real recording, against its ground truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

#include "core/angles.h"
#include "sensors/imu/module_angles.h"
#include "unit/sensors/imu/attitude_error.h"

namespace stereo_nav::imu {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

class AttitudeOfARecording : public testing::TestWithParam<AttitudeMethod> {};
INSTANTIATE_TEST_SUITE_P(Attitude, AttitudeOfARecording,
                         testing::Values(AttitudeMethod::kMahony, AttitudeMethod::kMadgwick));

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
  /// Ground truth within 3 ms of `time_s`, or none.
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

/// Errors of the filter's orientation from `start_s` on.
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
TEST_P(AttitudeOfARecording, FollowsTheGroundTruth) {
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
