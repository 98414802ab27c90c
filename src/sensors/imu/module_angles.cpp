#include "sensors/imu/module_angles.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::imu {
namespace {

constexpr double kDegree = M_PI / 180.0;

}  // namespace

double wrapDegrees(double angle_deg) {
  return std::remainder(angle_deg, 360.0);
}

Eigen::Quaterniond orientationFromModule(const ModuleAngles& angles) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return Eigen::Quaterniond(AngleAxisd(-angles.yaw_deg * kDegree, Vector3d::UnitZ()) *
                            AngleAxisd(-angles.pitch_deg * kDegree, Vector3d::UnitY()) *
                            AngleAxisd(angles.roll_deg * kDegree, Vector3d::UnitX()));
}

ModuleAngles moduleFromOrientation(const Eigen::Quaterniond& q_world_imu) {
  const Eigen::Matrix3d R = q_world_imu.normalized().toRotationMatrix();
  const double sin_pitch = std::clamp(-R(2, 0), -1.0, 1.0);
  double roll = 0.0;
  double yaw = std::atan2(-R(0, 1), R(1, 1));  // of the gimbal-locked attitude with zero roll
  if (std::abs(sin_pitch) < 1.0 - 1e-12) {
    roll = std::atan2(R(2, 1), R(2, 2));
    yaw = std::atan2(R(1, 0), R(0, 0));
  }
  return {-yaw / kDegree, -std::asin(sin_pitch) / kDegree, roll / kDegree};
}

double heading(const Eigen::Quaterniond& q_world_imu) {
  const Eigen::Vector3d x_axis = q_world_imu * Eigen::Vector3d::UnitX();
  return std::atan2(x_axis.y(), x_axis.x());
}

}  // namespace stereo_nav::imu
