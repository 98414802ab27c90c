#include "sensors/imu/module_angles.h"

#include <cmath>

#include "core/angles.h"
#include "core/roll_pitch_yaw.h"

namespace stereo_nav::imu {

Eigen::Quaterniond orientationFromModule(const ModuleAngles& angles) {
  return RollPitchYaw::fromDegrees(angles.roll_deg, -angles.pitch_deg, -angles.yaw_deg).quaternion();
}

ModuleAngles moduleFromOrientation(const Eigen::Quaterniond& q_world_imu) {
  const RollPitchYaw angles = RollPitchYaw::of(q_world_imu.toRotationMatrix());
  return {-angles.yaw * kDegPerRad, -angles.pitch * kDegPerRad, angles.roll * kDegPerRad};
}

double heading(const Eigen::Quaterniond& q_world_imu) {
  const Eigen::Vector3d x_axis = q_world_imu * Eigen::Vector3d::UnitX();
  return std::atan2(x_axis.y(), x_axis.x());
}

}  // namespace stereo_nav::imu
