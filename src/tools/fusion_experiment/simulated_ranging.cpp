#include "tools/fusion_experiment/simulated_ranging.h"

#include <array>
#include <cmath>
#include <utility>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "sim/distance_sensors.h"
#include "sim/random.h"

namespace stereo_nav::tools {
namespace {

constexpr double kFinderLongest_m = 12.0;
constexpr double kRangeBias_m = 0.05;
constexpr double kFinderLever_m = 0.15;

}  // namespace

std::vector<odometry::LaserScan> simulateScans(const sim::Scene& scene, const sim::Trajectory& trajectory,
                                               std::uint64_t seed) {
  sim::LaserModelParams params;
  params.noise_share = 0.01;
  params.dropout = 0.03;
  sim::LaserRig rig;
  rig.T_base_laser.translation().z() = kRangingHeight_m;
  sim::LaserModel laser(params, rig, seed);
  const auto base = [&trajectory](double time_s) { return trajectory.pose(time_s); };
  std::vector<odometry::LaserScan> scans;
  while (auto scan = laser.advance(scene, base, trajectory.duration_s())) {
    scans.push_back({scan->time_s, 0.0, -2.0 * kPi / rig.scan.beams, scan->time_increment_s,
                     rig.scan.range_min_m, rig.scan.range_max_m, std::move(scan->ranges_m)});
  }
  return scans;
}

std::vector<estimation::RangeReading> simulateRanges(const sim::Scene& scene,
                                                     const sim::Trajectory& trajectory, std::uint64_t seed) {
  sim::RandomStream random(sim::streamKey(seed, sim::Stream::kRange));
  std::array<double, kRangeFinders> bias_m{};
  for (double& bias : bias_m) bias = random.uniform(-kRangeBias_m, kRangeBias_m);
  std::vector<estimation::RangeReading> readings;
  for (int i = 0; i * kRangePeriod_s < trajectory.duration_s(); ++i) {
    for (std::size_t finder = 0; finder < kRangeFinders; ++finder) {
      estimation::RangeReading reading;
      reading.sensor = finder;
      reading.time_s = i * kRangePeriod_s;
      const Eigen::Isometry2d beam(Eigen::Rotation2Dd(0.5 * kPi * static_cast<double>(finder)) *
                                   Eigen::Translation2d(kFinderLever_m, 0.0));
      reading.T_base_sensor = beam;
      reading.half_width_rad = 0.02;
      reading.max_range_m = kFinderLongest_m;
      sim::RangeRig rig;
      rig.T_base_sensor = Eigen::Translation3d(0.0, 0.0, kRangingHeight_m) * inSpace(beam);
      rig.field_of_view_rad = 2.0 * reading.half_width_rad;
      rig.range_max_m = reading.max_range_m;
      const double range_m = sim::measureRange(sim::RangeModelParams(), rig, scene,
                                               trajectory.pose(reading.time_s), reading.time_s, random);
      reading.range_m = range_m + bias_m[finder];
      if (std::isfinite(range_m) && reading.range_m > 0.0) readings.push_back(reading);
    }
  }
  return readings;
}

}  // namespace stereo_nav::tools
