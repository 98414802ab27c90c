#include "odometry/stereo/imu_rotation.h"

#include <cmath>

namespace stereo_nav::odometry {

void ImuRotationParams::describe(ParameterVisitor& visitor) {
  visitor.real("initial_bias_sigma_rad_s", initial_bias_sigma_rad_s, {1e-6, 10.0}, "rad/s",
               "uncertainty of the rates' bias at the start");
  visitor.real("bias_walk_rad_s2", bias_walk_rad_s2, {0.0, 1.0}, "rad/s/sqrt(s)",
               "how fast the bias wanders");
  visitor.real("angle_sigma_rad", angle_sigma_rad, {1e-6, 1.0}, "rad",
               "uncertainty of a rotation between two frames without bias");
  visitor.real("angle_sigma_share", angle_sigma_share, {0.0, 1.0}, "",
               "its uncertainty as a share of the angle turned: scale, stamps and mounting");
}

ImuRotation::ImuRotation(const ImuRotationParams& params, const Eigen::Matrix3d& R_camera_imu)
    : params_(params), R_camera_imu_(R_camera_imu) {
  reset();
}

void ImuRotation::reset() {
  history_.clear();
  bias_.setZero();
  bias_variance_ = params_.initial_bias_sigma_rad_s * params_.initial_bias_sigma_rad_s;
}

std::optional<ImuRotation::Increment> ImuRotation::increment(double from_s, double to_s) const {
  const auto R_current_previous = history_.increment(from_s, to_s, R_camera_imu_);
  if (!R_current_previous) return std::nullopt;
  const double interval_s = to_s - from_s;
  const Eigen::Vector3d angle = logRotation(*R_current_previous);
  const double share = params_.angle_sigma_share * angle.norm();
  Increment increment;
  // R_current_previous turns by minus the rate, hence the plus.
  increment.R_current_previous = expRotation(angle + bias_ * interval_s);
  increment.sigma_rad = std::sqrt(params_.angle_sigma_rad * params_.angle_sigma_rad + share * share +
                                  bias_variance_ * interval_s * interval_s);
  return increment;
}

void ImuRotation::learn(double from_s, double to_s, const Eigen::Matrix3d& R_current_previous,
                        double sigma_rad) {
  const double interval_s = to_s - from_s;
  const auto imu = increment(from_s, to_s);
  if (!imu || interval_s <= 0.0) return;
  const Eigen::Vector3d difference = logRotation(R_current_previous) - logRotation(imu->R_current_previous);
  const double variance = imu->sigma_rad * imu->sigma_rad + sigma_rad * sigma_rad;
  constexpr double kGate = 5.0;
  if (difference.squaredNorm() > 3.0 * kGate * kGate * variance) return;
  bias_variance_ += params_.bias_walk_rad_s2 * params_.bias_walk_rad_s2 * interval_s;
  const double gain = bias_variance_ * interval_s / variance;
  bias_ += gain * difference;
  bias_variance_ *= 1.0 - gain * interval_s;
}

}  // namespace stereo_nav::odometry
