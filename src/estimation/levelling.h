#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "core/rotation_history.h"

namespace stereo_nav::estimation {

/// Attitude of the base at `time_s` with z up and yaw 0: from the IMU's own attitude where it has one, else
/// from the mean specific force of the second before, which assumes that the robot stands or rolls evenly.
/// Nothing if the samples hold neither.
std::optional<Eigen::Matrix3d> levelledAttitude(const RotationHistory& history, double time_s,
                                                const Eigen::Matrix3d& R_base_imu);

}  // namespace stereo_nav::estimation
