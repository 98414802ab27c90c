#pragma once

#include "core/rotation_history.h"
#include "mapping/mono/mono_motion.h"

namespace stereo_nav::mapping {

/// The mean turn of the camera between two frames by an IMU; nothing where its samples do not cover them.
std::optional<MeasuredTurn> turnBetween(const RotationHistory& imu, double from_s, double to_s,
                                        const Eigen::Matrix3d& R_camera_imu,
                                        const MeasuredMotionParams& params);

/// The mean velocity of the camera between two frames by another odometry, which gives the scale:
/// `T_before_now` is the motion of the camera in `duration_s`.
MeasuredVelocity velocityOf(const Eigen::Isometry3d& T_before_now, double duration_s,
                            const MeasuredMotionParams& params);

}  // namespace stereo_nav::mapping
