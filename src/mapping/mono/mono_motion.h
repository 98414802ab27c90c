#pragma once

#include <optional>

#include "mapping/mono/mono_params.h"
#include "mapping/mono/mono_state.h"

namespace stereo_nav::mapping {

/// A rate of turn that a gyroscope measured: rad/s in the axes of the camera, mean over the time since the
/// last frame, and its standard deviation.
struct MeasuredTurn {
  Eigen::Vector3d omega_camera;
  double sigma_rad_per_s;
};

/// A velocity that wheels or another odometry measured: m/s in the axes of the camera.
struct MeasuredVelocity {
  Eigen::Vector3d v_camera;
  Eigen::Matrix3d covariance;
};

/// The camera after `duration_s` of constant velocity and rate of turn, with the derivative of its errors.
CameraState movedCamera(const CameraState& camera, double duration_s, Matrix12d* transition = nullptr);

/// Constant velocity and rate of turn, whose changes are white noise (Davison et al. 2007, section 3.1). A
/// measured turn takes the place of the filter's own rate.
void predict(MonoState& state, double duration_s, const MotionNoise& noise,
             const std::optional<MeasuredTurn>& turn = std::nullopt);

/// Corrects by a measured velocity; this gives the map its scale.
void correctByVelocity(MonoState& state, const MeasuredVelocity& velocity);

/// Puts a copy of the camera's pose into the state, for relativeTo(). Returns its id.
int addPastPose(MonoState& state);

}  // namespace stereo_nav::mapping
