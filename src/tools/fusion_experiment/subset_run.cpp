#include "tools/fusion_experiment/subset_run.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "estimation/ekf/fusion_filter.h"
#include "estimation/ekf/fusion_setup.h"
#include "tools/fusion_experiment/simulated_ranging.h"

namespace stereo_nav::tools {
namespace {

using estimation::FusionConfig;
using estimation::FusionSetup;

FusionConfig configOf(FusionConfig config, const Subset& subset) {
  const auto unused = [&subset](const estimation::SensorConfig& sensor) {
    if (sensor.type == estimation::SensorType::kImu) return !subset.imu;
    if (sensor.topic == "wheel/odom") return !subset.wheels;
    return sensor.topic == "laser/odom" ? !subset.laser : !subset.stereo;
  };
  config.sensors.erase(std::remove_if(config.sensors.begin(), config.sensors.end(), unused),
                       config.sensors.end());
  return config;
}

/// All measurements of the subset with their channels, in the order of receipt.
std::vector<Sensed> inputOf(const FusionConfig& config, const FusionSetup& setup, const Subset& subset,
                            const SensorRuns& runs) {
  std::vector<Sensed> input;
  for (std::size_t i = 0; i < config.sensors.size(); ++i) {
    const estimation::SensorConfig& sensor = config.sensors[i];
    const estimation::SensorChannels& channels = setup.sensors[i];
    const std::vector<Sensed>* source = &runs.stereo[subset.imu ? 1 : 0];
    if (sensor.topic == "laser/odom") source = &runs.laser[(subset.imu ? 2 : 0) + (subset.wheels ? 1 : 0)];
    if (sensor.topic == "wheel/odom") source = &runs.wheels;
    if (sensor.type == estimation::SensorType::kImu) source = &runs.gyro;
    for (Sensed sensed : *source) {
      const bool motion = sensed.measurement.kind == estimation::Measurement::Kind::kMotion;
      sensed.measurement.channel = motion ? channels.pose : channels.twist;
      sensed.measurement.fields = motion ? channels.pose_fields : channels.twist_fields;
      input.push_back(std::move(sensed));
    }
  }
  std::stable_sort(input.begin(), input.end(),
                   [](const Sensed& a, const Sensed& b) { return a.received_s < b.received_s; });
  return input;
}

ComparedPose compare(double time_s, const Eigen::Isometry2d& T_true, const Eigen::Isometry2d& T_estimated,
                     const Eigen::Matrix3d& covariance) {
  ComparedPose pose{time_s, T_true, {}, 0.0};
  pose.error << T_estimated.translation() - T_true.translation(), yawOf(T_true.inverse() * T_estimated);
  pose.nees = pose.error.dot((covariance + 1e-12 * Eigen::Matrix3d::Identity()).ldlt().solve(pose.error));
  return pose;
}

estimation::RangeCorrector startedCorrector(const grid::OccupancyGrid& map) {
  estimation::RangeCorrector corrector(estimation::RangeParams(), kRangeFinders);
  corrector.setMap(map);
  corrector.setPose(Eigen::Isometry2d::Identity(), Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal());
  return corrector;
}

}  // namespace

std::string Subset::name() const {
  std::string text;
  const auto add = [&text](bool used, const char* name) {
    if (used) text += (text.empty() ? "" : " ") + std::string(name);
  };
  add(wheels, "wheels");
  add(laser, "laser");
  add(imu, "IMU");
  add(stereo, "stereo");
  add(ranges, "ranges");
  return text;
}

std::vector<Subset> allSubsets() {
  std::vector<Subset> subsets;
  for (int ranges = 0; ranges < 2; ++ranges) {
    for (int odometries = 1; odometries < 8; ++odometries) {
      for (int imu = 0; imu < 2; ++imu)
        subsets.push_back(
            {(odometries & 1) != 0, (odometries & 2) != 0, imu != 0, (odometries & 4) != 0, ranges != 0});
    }
  }
  return subsets;
}

std::vector<ComparedPose> runSubset(const FusionConfig& all, const Subset& subset, const SensorRuns& runs,
                                    const sim::Trajectory& trajectory) {
  const FusionConfig config = configOf(all, subset);
  const FusionSetup setup = estimation::setUp(config);
  estimation::FusionFilter filter(config.params.filter, setup.parts, setup.channels);
  estimation::RangeCorrector corrector = startedCorrector(runs.map);
  const std::vector<Sensed> input = inputOf(config, setup, subset, runs);
  auto next = input.begin();
  auto reading = runs.ranges.begin();
  std::vector<ComparedPose> poses;
  for (int i = 1; i * kRangePeriod_s < trajectory.duration_s(); ++i) {
    const double time_s = i * kRangePeriod_s;
    for (; next != input.end() && next->received_s <= kStart_s + time_s; ++next)
      filter.add(next->measurement, next->received_s);
    if (!filter.started()) continue;
    const estimation::FusedEstimate estimate = filter.estimate(kStart_s + time_s);
    const Eigen::Isometry2d T_odom_base = planarPart(estimate.T_world_base);
    const Eigen::Isometry2d T_true = planarPart(trajectory.pose(time_s));
    if (!subset.ranges) {
      poses.push_back(compare(time_s, T_true, T_odom_base, planarCovariance(estimate.pose_covariance)));
      continue;
    }
    for (; reading != runs.ranges.end() && reading->time_s < time_s + 0.5 * kRangePeriod_s; ++reading)
      corrector.add(*reading, T_odom_base, planarCovariance(estimate.pose_covariance));
    poses.push_back(compare(time_s, T_true, corrector.T_map_odom() * T_odom_base, corrector.covariance()));
  }
  return poses;
}

}  // namespace stereo_nav::tools
