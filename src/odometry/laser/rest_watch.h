#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "core/planar_motion.h"

namespace stereo_nav::odometry {

/// Whether a base has stayed where it was for a second: within what the noise of a scan feigns.
class RestWatch {
 public:
  /// Poses in order of time.
  bool observe(double time_s, const Eigen::Isometry2d& T_odom_base) {
    constexpr double kStill_m = 0.01, kStill_rad = 0.01, kRest_s = 1.0;
    if (since_) {
      const Eigen::Isometry2d moved = since_->T_odom_base.inverse() * T_odom_base;
      const bool still = moved.translation().norm() < kStill_m && std::abs(yawOf(moved)) < kStill_rad;
      if (still && time_s >= since_->time_s) return time_s - since_->time_s >= kRest_s;
    }
    since_ = Place{time_s, T_odom_base};
    return false;
  }

 private:
  struct Place {
    double time_s;
    Eigen::Isometry2d T_odom_base;
  };
  std::optional<Place> since_;
};

}  // namespace stereo_nav::odometry
