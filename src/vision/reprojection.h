#pragma once

#include <Eigen/Core>

#include "vision/stereo_view.h"

namespace stereo_nav::vision {

/// Weight of an observation with the Cauchy loss of scale `loss_px`, both scaled to its own noise.
double robustWeight(const Eigen::Vector4d& error_px, double noise, double loss_px);

/// The derivative of a point by a left perturbation T <- expMotion(delta) T of the motion that brought it to
/// `p`.
Eigen::Matrix<double, 3, 6> perturbationJacobian(const Eigen::Vector3d& p);

/// Residuals (observed - projected) of both images and their derivatives by left perturbations of
/// T_camera_world and T_late_camera. Returns false for a point behind a camera.
struct ViewResidual {
  Eigen::Vector4d error_px = Eigen::Vector4d::Zero();  ///< left x, y, right x, y; 0 where not observed
  Eigen::Matrix<double, 4, 6> by_pose = Eigen::Matrix<double, 4, 6>::Zero();
  Eigen::Matrix<double, 2, 6> by_late = Eigen::Matrix<double, 2, 6>::Zero();
  Eigen::Matrix<double, 4, 3> by_camera_point = Eigen::Matrix<double, 4, 3>::Zero();
};
bool viewResidual(const StereoCalibration& calibration, const StereoView& view,
                  const Eigen::Vector3d& p_world, const StereoObservation& seen, ViewResidual& residual);

}  // namespace stereo_nav::vision
