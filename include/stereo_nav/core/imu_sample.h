#pragma once

#include <Eigen/Geometry>
#include <optional>

namespace stereo_nav {

/// One IMU message. Quantities that the module does not deliver are absent.
struct ImuSample {
  double time_s = 0.0;                                 ///< seconds since the epoch of the image stamps
  std::optional<Eigen::Quaterniond> q_world_imu;       ///< attitude; its yaw may count from power-on
  std::optional<Eigen::Vector3d> angular_velocity;     ///< rad/s, IMU frame
  std::optional<Eigen::Vector3d> linear_acceleration;  ///< m/s^2, IMU frame, gravity included

  /// Whether all delivered values are finite numbers.
  bool isFinite() const {
    return (!q_world_imu || q_world_imu->coeffs().allFinite()) &&
           (!angular_velocity || angular_velocity->allFinite()) &&
           (!linear_acceleration || linear_acceleration->allFinite());
  }
};

}  // namespace stereo_nav
