#include "sim/distance_sensors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angles.h"

namespace stereo_nav::sim {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// By REP-117.
double limited(double range_m, double least_m, double most_m) {
  if (range_m < least_m) return -kInfinite;
  return range_m > most_m ? kInfinite : range_m;
}

}  // namespace

LaserModel::LaserModel(const LaserModelParams& params, const LaserRig& rig, std::uint64_t seed)
    : params_(params), rig_(rig), random_(streamKey(seed, Stream::kLaser)) {}

float LaserModel::measure(const Scene& scene, const BasePath& base, double time_s, std::size_t beam) {
  const Eigen::Isometry3d T_world_laser = base(time_s) * rig_.T_base_laser;
  const double angle_rad = -2.0 * kPi * static_cast<double>(beam) / rig_.scan.beams;
  const Eigen::Vector3d direction =
      T_world_laser.linear() * Eigen::Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0.0);
  const double normal = random_.normal();
  const bool lost = random_.uniform(0.0, 1.0) < params_.dropout;
  if (lost) return std::numeric_limits<float>::quiet_NaN();
  const double range_m = scene.castRay(T_world_laser.translation(), direction, time_s);
  const double sigma_m = std::max(params_.noise_m, params_.noise_share * range_m);
  return static_cast<float>(
      limited(range_m + sigma_m * normal, rig_.scan.range_min_m, rig_.scan.range_max_m));
}

std::optional<laser::Scan> LaserModel::advance(const Scene& scene, const BasePath& base, double now_s) {
  const auto beams = static_cast<std::size_t>(rig_.scan.beams);
  if (scan_.ranges_m.empty()) {
    scan_.scan_time_s = 1.0 / params_.rate_hz;
    scan_.time_increment_s = scan_.scan_time_s / rig_.scan.beams;
    scan_.time_s = static_cast<double>(revolutions_) / params_.rate_hz;
  }
  while (scan_.ranges_m.size() < beams) {
    const std::size_t beam = scan_.ranges_m.size();
    const double time_s = scan_.time_s + static_cast<double>(beam) * scan_.time_increment_s;
    if (time_s > now_s) return std::nullopt;
    scan_.ranges_m.push_back(measure(scene, base, time_s, beam));
    scan_.qualities.push_back(std::isfinite(scan_.ranges_m.back()) ? 47.0F : 0.0F);
  }
  ++revolutions_;
  return std::exchange(scan_, {});
}

double measureRange(const RangeModelParams& params, const RangeRig& rig, const Scene& scene,
                    const Eigen::Isometry3d& T_world_base, double time_s, RandomStream& random) {
  constexpr int kAround = 8;
  const Eigen::Isometry3d T_world_sensor = T_world_base * rig.T_base_sensor;
  const double across = std::tan(0.5 * rig.field_of_view_rad);
  const auto cast = [&](double y, double z) {
    return scene.castRay(T_world_sensor.translation(),
                         T_world_sensor.linear() * Eigen::Vector3d(1.0, y, z).normalized(), time_s);
  };
  double nearest_m = cast(0.0, 0.0);
  for (int i = 0; i < kAround; ++i) {
    const double angle_rad = 2.0 * kPi * i / kAround;
    nearest_m = std::min(nearest_m, cast(across * std::cos(angle_rad), across * std::sin(angle_rad)));
  }
  return limited(nearest_m + params.noise_m * random.normal(), rig.range_min_m, rig.range_max_m);
}

}  // namespace stereo_nav::sim
