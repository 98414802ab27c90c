#include "core/roll_pitch_yaw.h"

#include <cmath>

#include "core/angles.h"

namespace stereo_nav {

RollPitchYaw RollPitchYaw::fromDegrees(double roll_deg, double pitch_deg, double yaw_deg) {
  return {roll_deg * kRadPerDeg, pitch_deg * kRadPerDeg, yaw_deg * kRadPerDeg};
}

RollPitchYaw RollPitchYaw::of(const Eigen::Matrix3d& R) {
  constexpr double kVertical = 1e-6;  // limit of the horizontal length of the rotated unit x axis
  const double level = std::hypot(R(0, 0), R(1, 0));
  RollPitchYaw angles;
  angles.pitch = std::atan2(-R(2, 0), level);
  if (level < kVertical) {
    angles.yaw = std::atan2(-R(0, 1), R(1, 1));
  } else {
    angles.roll = std::atan2(R(2, 1), R(2, 2));
    angles.yaw = std::atan2(R(1, 0), R(0, 0));
  }
  return angles;
}

Eigen::Quaterniond RollPitchYaw::quaternion() const {
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
}

}  // namespace stereo_nav
