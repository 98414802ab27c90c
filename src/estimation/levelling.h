#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "core/rotation_history.h"

namespace stereo_nav::estimation {

/// Attitude of the base at `time_s` with z up and yaw 0. It follows from the IMU's own attitude where there
/// is one, otherwise from the mean specific force over the second before, which assumes that the robot stands
/// or moves at constant velocity. Returns nothing if the samples hold neither.
std::optional<Eigen::Matrix3d> levelledAttitude(const RotationHistory& history, double time_s,
                                                const Eigen::Matrix3d& R_base_imu);

}  // namespace stereo_nav::estimation
