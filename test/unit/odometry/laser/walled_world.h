#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "core/angles.h"
#include "odometry/laser/laser_odometry.h"

namespace stereo_nav::odometry {

/// Walls that a laser sees, each from its first point to its second.
struct WalledWorld {
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> walls;

  /// A room of this size around the origin, with a cupboard in a corner that tells its sides apart.
  static WalledWorld room(double length_m, double width_m) {
    const double x = 0.5 * length_m, y = 0.5 * width_m;
    return {{{{-x, -y}, {x, -y}},
             {{x, -y}, {x, y}},
             {{x, y}, {-x, y}},
             {{-x, y}, {-x, -y}},
             {{x - 1.0, y}, {x - 1.0, y - 0.5}},
             {{x - 1.0, y - 0.5}, {x, y - 0.5}}}};
  }
  /// Two walls without an end in reach.
  static WalledWorld corridor(double width_m) {
    return {{{{-500.0, 0.5 * width_m}, {500.0, 0.5 * width_m}},
             {{-500.0, -0.5 * width_m}, {500.0, -0.5 * width_m}}}};
  }

  double range_m(const Eigen::Vector2d& from, double direction_rad) const {
    const Eigen::Vector2d u(std::cos(direction_rad), std::sin(direction_rad));
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : walls) {
      const Eigen::Vector2d v = b - a, w = a - from;
      const double cross = u.x() * v.y() - u.y() * v.x();
      if (std::abs(cross) < 1e-12) continue;
      const double along_m = (w.x() * v.y() - w.y() * v.x()) / cross;
      const double share = (w.x() * u.y() - w.y() * u.x()) / cross;
      if (along_m > 0.0 && share >= 0.0 && share <= 1.0) nearest_m = std::min(nearest_m, along_m);
    }
    return nearest_m;
  }
};

/// Pose (m, m, rad) of the base at a time.
using PlanarPath = std::function<Eigen::Vector3d(double time_s)>;

inline Eigen::Isometry2d planarPose(const Eigen::Vector3d& pose) {
  Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
  T.translation() = pose.head<2>();
  T.rotate(pose.z());
  return T;
}

/// A laser of 360 beams that turns ten times a second, at the base.
struct TurningLaser {
  WalledWorld world;
  PlanarPath path;
  double sigma_m = 0.01;
  double sweep_s = 0.1;
  std::mt19937 random{1};

  LaserScan scan(double time_s) {
    LaserScan scan;
    scan.time_s = time_s;
    scan.angle_min_rad = -kPi;
    scan.angle_increment_rad = 2.0 * kPi / 360.0;
    scan.time_increment_s = sweep_s / 360.0;
    scan.range_min_m = 0.1;
    scan.range_max_m = 12.0;
    std::normal_distribution<double> noise(0.0, 1.0);  // of no width it would not be defined
    for (int i = 0; i < 360; ++i) {
      const Eigen::Vector3d pose = path(time_s + i * scan.time_increment_s);
      const double range_m =
          world.range_m(pose.head<2>(), pose.z() + scan.angle_min_rad + i * scan.angle_increment_rad);
      scan.ranges_m.push_back(range_m < scan.range_max_m
                                  ? static_cast<float>(range_m + sigma_m * noise(random))
                                  : std::numeric_limits<float>::infinity());
    }
    return scan;
  }
};

/// What the odometry's motion since the first scan lacks of the path's: m, m, rad in the base's axes.
inline Eigen::Vector3d poseError(const LaserOdometryResult& result, const PlanarPath& path, double first_s) {
  const Eigen::Isometry2d truth = planarPose(path(first_s)).inverse() * planarPose(path(result.time_s));
  const Eigen::Isometry2d error = truth.inverse() * result.T_odom_base;
  return {error.translation().x(), error.translation().y(), std::atan2(error(1, 0), error(0, 0))};
}

}  // namespace stereo_nav::odometry
