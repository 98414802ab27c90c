#include "estimation/levelling.h"

#include <cmath>

#include "core/roll_pitch_yaw.h"

namespace stereo_nav::estimation {

std::optional<Eigen::Matrix3d> levelledAttitude(const RotationHistory& history, double time_s,
                                                const Eigen::Matrix3d& R_base_imu) {
  Eigen::Vector3d up_base;
  if (const auto q_world_imu = history.attitude(time_s)) {
    up_base = R_base_imu * (q_world_imu->inverse() * Eigen::Vector3d::UnitZ());
  } else if (const auto force_imu = history.meanAcceleration(time_s - 1.0, time_s)) {
    constexpr double kFreeFall_m_s2 = 1.0;
    if (force_imu->norm() < kFreeFall_m_s2) return std::nullopt;
    up_base = R_base_imu * force_imu->normalized();
  } else {
    return std::nullopt;
  }
  // Roll and pitch that rotate the measured upward direction onto z.
  const double roll_rad = std::atan2(up_base.y(), up_base.z());
  const double pitch_rad = std::atan2(-up_base.x(), std::hypot(up_base.y(), up_base.z()));
  return RollPitchYaw{roll_rad, pitch_rad, 0.0}.rotation();
}

}  // namespace stereo_nav::estimation
