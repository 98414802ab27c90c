#pragma once

#include <optional>

#include "core/rotation_history.h"
#include "stereo_nav/core/lie.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::odometry {

struct ImuRotationParams {
  double initial_bias_sigma_rad_s = 0.1;
  double bias_walk_rad_s2 = 0.0005;
  double angle_sigma_rad = 0.0005;
  double angle_sigma_share = 0.01;

  void describe(ParameterVisitor& visitor);
};

/// Rotations of the camera from the IMU, freed from the bias of its rates, which vision reveals: a Kalman
/// filter with the bias as a random walk and the difference of the two rotations as its measurement.
class ImuRotation {
 public:
  ImuRotation(const ImuRotationParams& params, const Eigen::Matrix3d& R_camera_imu);

  void add(const ImuSample& sample) { history_.add(sample); }
  void reset();

  struct Increment {
    Eigen::Matrix3d R_current_previous;  ///< coordinates of the camera frame at `from_s` into those at `to_s`
    double sigma_rad;                    ///< per axis, bias included
  };
  /// The rotation over the interval; nothing if the samples do not cover it.
  std::optional<Increment> increment(double from_s, double to_s) const;

  /// Takes the rotation that vision found for the same interval; `sigma_rad` is per axis. Differences beyond
  /// 5 sigma are no bias and are ignored.
  void learn(double from_s, double to_s, const Eigen::Matrix3d& R_current_previous, double sigma_rad);

  const Eigen::Vector3d& bias() const { return bias_; }  ///< rad/s, camera frame

 private:
  ImuRotationParams params_;
  Eigen::Matrix3d R_camera_imu_;
  RotationHistory history_;
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
  double bias_variance_;
};

}  // namespace stereo_nav::odometry
