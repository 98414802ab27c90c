#pragma once

#include <Eigen/Geometry>

namespace stereo_nav::imu {

/// What the angle module sends: degrees in the module's own front-right-down convention.
struct ModuleAngles {
  double yaw_deg = 0.0;
  double pitch_deg = 0.0;
  double roll_deg = 0.0;

  Eigen::Vector3d vector() const { return {yaw_deg, pitch_deg, roll_deg}; }
};

/// Attitude of the IMU frame (front-left-up, REP-103) in a world with z up: the quaternion of the fixed-axis
/// (x, y, z) Euler angles (roll, -pitch, -yaw).
/// Yaw 30, pitch 10, roll -5 gives (x, y, z, w) = (-0.0645, -0.0729, -0.2613, 0.9604).
Eigen::Quaterniond orientationFromModule(const ModuleAngles& angles);

/// The inverse; pitch within [-90, 90]. At pitch +-90 the roll is reported as zero.
ModuleAngles moduleFromOrientation(const Eigen::Quaterniond& q_world_imu);

/// Heading of the IMU's x axis about the world's vertical, radians, counter-clockwise, within [-pi, pi].
double heading(const Eigen::Quaterniond& q_world_imu);

}  // namespace stereo_nav::imu
