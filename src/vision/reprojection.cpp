#include "vision/reprojection.h"

namespace stereo_nav::vision {

Eigen::Matrix<double, 3, 6> perturbationJacobian(const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian << Eigen::Matrix3d::Identity(), -hat(p);
  return jacobian;
}

double robustWeight(const Eigen::Vector4d& error_px, double noise, double loss_px) {
  const double scale_px = loss_px * noise;
  return 1.0 / (noise * noise * (1.0 + error_px.squaredNorm() / (scale_px * scale_px)));
}

bool viewResidual(const StereoCalibration& calibration, const StereoView& view,
                  const Eigen::Vector3d& p_world, const StereoObservation& seen, ViewResidual& residual) {
  const Eigen::Vector3d p_camera = view.T_camera_world * p_world;
  if (p_camera.z() < kNearestDepth_m) return false;
  residual = ViewResidual();
  if (seen.has_left) {
    residual.error_px.head<2>() = seen.left_px - projectLeft(calibration, p_camera);
    residual.by_camera_point.topRows<2>() = -leftProjectionJacobian(calibration, p_camera);
  }
  if (seen.has_right) {
    const Eigen::Vector3d p_late = view.T_late_camera * p_camera;
    if (p_late.z() < kNearestDepth_m) return false;
    residual.error_px.tail<2>() = seen.right_px - projectRight(calibration, p_late);
    const Eigen::Matrix<double, 2, 3> by_late_point = -rightProjectionJacobian(calibration, p_late);
    residual.by_late = by_late_point * perturbationJacobian(p_late);
    residual.by_camera_point.bottomRows<2>() = by_late_point * view.T_late_camera.linear();
  }
  residual.by_pose.leftCols<3>() = residual.by_camera_point;
  residual.by_pose.rightCols<3>() = -residual.by_camera_point * hat(p_camera);
  return true;
}

}  // namespace stereo_nav::vision
