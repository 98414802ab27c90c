#include "tools/fusion_experiment/simulated_ranging.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "sim/random.h"

namespace stereo_nav::tools {
namespace {

constexpr int kBeams = 360;
constexpr double kScanPeriod_s = 0.1;
constexpr double kLongest_m = 12.0;
constexpr double kShortest_m = 0.15;
constexpr double kDropouts = 0.03;
constexpr double kRangeSigma_m = 0.01;
constexpr double kRangeBias_m = 0.05;
constexpr double kFinderLever_m = 0.15;
constexpr double kCell_m = 0.02;
/// Streams of random numbers beyond those of the simulator.
constexpr std::uint64_t kScanStream = 101, kRangeStream = 102;

/// Distance along a level beam that leaves the base at an angle.
double distanceAlong(const sim::Scene& scene, const Eigen::Isometry3d& T_world_base,
                     const Eigen::Isometry2d& T_base_beam, double time_s) {
  const Eigen::Isometry3d T =
      T_world_base * Eigen::Translation3d(0.0, 0.0, kRangingHeight_m) * inSpace(T_base_beam);
  return scene.castRay(T.translation(), T.linear().col(0), time_s);
}

Eigen::Isometry2d beamAt(double angle_rad, double lever_m) {
  Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
  T.linear() = Eigen::Rotation2Dd(angle_rad).toRotationMatrix();
  T.translation() = lever_m * T.linear().col(0);
  return T;
}

bool holds(const sim::Solid& solid, const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d p = (solid.R_solid_world * (p_world - solid.p_world)).cwiseAbs();
  const Eigen::Vector3d half = solid.half.cast<double>();
  if (p.z() > half.z()) return false;
  if (solid.kind == sim::Solid::Kind::kCylinder) return p.head<2>().norm() <= half.x();
  return p.x() <= half.x() && p.y() <= half.y();
}

}  // namespace

std::vector<odometry::LaserScan> simulateScans(const sim::Scene& scene, const sim::Trajectory& trajectory,
                                               std::uint64_t seed) {
  sim::RandomStream random(sim::streamKey(seed, kScanStream));
  std::vector<odometry::LaserScan> scans;
  for (int i = 0; (i + 1) * kScanPeriod_s < trajectory.duration_s(); ++i) {
    odometry::LaserScan scan;
    scan.time_s = i * kScanPeriod_s;
    scan.angle_increment_rad = 2.0 * kPi / kBeams;
    scan.time_increment_s = kScanPeriod_s / kBeams;
    scan.range_min_m = kShortest_m;
    scan.range_max_m = kLongest_m;
    for (int beam = 0; beam < kBeams; ++beam) {
      const double time_s = scan.time_s + beam * scan.time_increment_s;
      const double range_m =
          distanceAlong(scene, trajectory.pose(time_s), beamAt(beam * scan.angle_increment_rad, 0.0), time_s);
      const double noise_m = std::max(0.005, 0.01 * range_m) * random.normal();
      const bool lost = random.uniform(0.0, 1.0) < kDropouts || range_m > kLongest_m || range_m < kShortest_m;
      scan.ranges_m.push_back(lost ? std::numeric_limits<float>::infinity()
                                   : static_cast<float>(range_m + noise_m));
    }
    scans.push_back(std::move(scan));
  }
  return scans;
}

std::vector<estimation::RangeReading> simulateRanges(const sim::Scene& scene,
                                                     const sim::Trajectory& trajectory, std::uint64_t seed) {
  sim::RandomStream random(sim::streamKey(seed, kRangeStream));
  std::array<double, kRangeFinders> bias_m{};
  for (double& bias : bias_m) bias = random.uniform(-kRangeBias_m, kRangeBias_m);
  std::vector<estimation::RangeReading> readings;
  for (int i = 0; i * kRangePeriod_s < trajectory.duration_s(); ++i) {
    for (std::size_t finder = 0; finder < kRangeFinders; ++finder) {
      estimation::RangeReading reading;
      reading.sensor = finder;
      reading.time_s = i * kRangePeriod_s;
      reading.T_base_sensor = beamAt(0.5 * kPi * static_cast<double>(finder), kFinderLever_m);
      reading.half_width_rad = 0.02;
      reading.max_range_m = kLongest_m;
      const double range_m =
          distanceAlong(scene, trajectory.pose(reading.time_s), reading.T_base_sensor, reading.time_s);
      reading.range_m = range_m + bias_m[finder] + kRangeSigma_m * random.normal();
      if (range_m < kLongest_m && reading.range_m > 0.0) readings.push_back(reading);
    }
  }
  return readings;
}

grid::OccupancyGrid wallsOf(const sim::Scene& scene, const sim::RoomParams& room) {
  grid::GridGeometry geometry;
  geometry.resolution_m = kCell_m;
  geometry.origin_x_m = room.x_min_m - 0.1;
  geometry.origin_y_m = room.y_min_m - 0.1;
  geometry.width = static_cast<int>(std::ceil((room.x_max_m - room.x_min_m + 0.2) / kCell_m));
  geometry.height = static_cast<int>(std::ceil((room.y_max_m - room.y_min_m + 0.2) / kCell_m));
  grid::OccupancyGrid map(geometry, grid::kFree);
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const Eigen::Vector2d centre = geometry.centreOf({x, y});
      const Eigen::Vector3d p(centre.x(), centre.y(), kRangingHeight_m);
      const bool occupied =
          std::any_of(scene.solids().begin(), scene.solids().end(), [&p](const sim::Solid& solid) {
            if (solid.kind == sim::Solid::Kind::kRoom) return !holds(solid, p);
            return solid.walk_m.isZero() && holds(solid, p);
          });
      if (occupied) map.at({x, y}) = grid::kOccupied;
    }
  }
  return map;
}

}  // namespace stereo_nav::tools
