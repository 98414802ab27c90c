#pragma once

#include <algorithm>
#include <cmath>

#include "stereo_nav/sensors/imu/attitude_filter.h"

namespace stereo_nav::imu {

constexpr double kDegree = M_PI / 180.0;

struct TiltAndYaw {
  double tilt_deg;
  double yaw_deg;
};

/// How far an estimate's horizon is tilted, and its heading turned, against the truth.
inline TiltAndYaw errorOf(const Eigen::Quaterniond& estimate, const Eigen::Quaterniond& truth) {
  const Eigen::Quaterniond difference = estimate * truth.conjugate();  // in the world
  const Eigen::Vector3d up = difference * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d x = difference * Eigen::Vector3d::UnitX();
  return {std::acos(std::min(1.0, up.z())) / kDegree, std::atan2(x.y(), x.x()) / kDegree};
}

inline AttitudeParams paramsOf(AttitudeMethod method, bool magnetometer = false) {
  AttitudeParams params;
  params.method = method;
  params.use_magnetometer = magnetometer;
  return params;
}

}  // namespace stereo_nav::imu
