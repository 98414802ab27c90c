#pragma once

#include "stereo_nav/sensors/imu/attitude_filter.h"

namespace stereo_nav::imu {

/// Gradient-descent filter: Madgwick, "An efficient orientation filter for inertial and inertial/magnetic
/// sensor arrays", 2010; equations in the code. His quaternion is the conjugate of ours. Reference
/// directions: z up for the accelerometer at rest, and north (y) and down for the magnetic field.
class MadgwickFilter : public AttitudeFilter {
 public:
  using AttitudeFilter::AttitudeFilter;

  /// Sum of squared differences between measured and expected directions, and its gradient with respect to
  /// (w, x, y, z). An absent direction (null) contributes nothing. Public for the test against numeric
  /// differences.
  static double objective(const Eigen::Vector4d& wxyz, const Eigen::Vector3d* up,
                          const Eigen::Vector3d* field, const Eigen::Vector3d& field_reference);
  static Eigen::Vector4d gradient(const Eigen::Vector4d& wxyz, const Eigen::Vector3d* up,
                                  const Eigen::Vector3d* field, const Eigen::Vector3d& field_reference);

 private:
  void step(const Eigen::Vector3d& angular_velocity, const Directions& measured, double dt_s) override;
};

}  // namespace stereo_nav::imu
