#include "vision/stereo_view.h"

#include <limits>

namespace stereo_nav::vision {

Eigen::Vector2d projectLeft(const StereoCalibration& calibration, const Eigen::Vector3d& p_camera) {
  const double inverse_z = 1.0 / p_camera.z();
  return {calibration.fx * p_camera.x() * inverse_z + calibration.cx,
          calibration.fy * p_camera.y() * inverse_z + calibration.cy};
}

Eigen::Vector2d projectRight(const StereoCalibration& calibration, const Eigen::Vector3d& p_late) {
  const double inverse_z = 1.0 / p_late.z();
  return {calibration.fx * (p_late.x() - calibration.baseline_m) * inverse_z + calibration.right_cx,
          calibration.fy * p_late.y() * inverse_z + calibration.cy};
}

Eigen::Matrix<double, 2, 3> leftProjectionJacobian(const StereoCalibration& calibration,
                                                   const Eigen::Vector3d& p_camera) {
  const double inverse_z = 1.0 / p_camera.z();
  const double fx_z = calibration.fx * inverse_z;
  const double fy_z = calibration.fy * inverse_z;
  Eigen::Matrix<double, 2, 3> jacobian;
  jacobian << fx_z, 0.0, -fx_z * p_camera.x() * inverse_z, 0.0, fy_z, -fy_z * p_camera.y() * inverse_z;
  return jacobian;
}

Eigen::Matrix<double, 2, 3> rightProjectionJacobian(const StereoCalibration& calibration,
                                                    const Eigen::Vector3d& p_late) {
  return leftProjectionJacobian(calibration, p_late - calibration.baseline_m * Eigen::Vector3d::UnitX());
}

Eigen::Vector3d leftRay(const StereoCalibration& calibration, const Eigen::Vector2d& left_px) {
  return {(left_px.x() - calibration.cx) / calibration.fx, (left_px.y() - calibration.cy) / calibration.fy,
          1.0};
}

Eigen::Vector2d transferToRight(const StereoCalibration& calibration, const Eigen::Isometry3d& T_late_camera,
                                const Eigen::Vector2d& left_px, double inverse_depth) {
  const Eigen::Vector3d baseline = calibration.baseline_m * Eigen::Vector3d::UnitX();
  // Homogeneous in depth, so that infinity is a value like any other.
  const Eigen::Vector3d q = T_late_camera.linear() * leftRay(calibration, left_px) +
                            inverse_depth * (T_late_camera.translation() - baseline);
  if (q.z() <= 0.0) return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  return {calibration.fx * q.x() / q.z() + calibration.right_cx,
          calibration.fy * q.y() / q.z() + calibration.cy};
}

Triangulation triangulate(const StereoCalibration& calibration, const Eigen::Isometry3d& T_late_camera,
                          const Eigen::Vector2d& left_px, const Eigen::Vector2d& right_px) {
  const Eigen::Vector3d ray = T_late_camera.linear() * leftRay(calibration, left_px);
  const Eigen::Vector3d shift =
      T_late_camera.translation() - calibration.baseline_m * Eigen::Vector3d::UnitX();
  // (ray + inverse_depth * shift) must lie on the ray of right_px: two equations, linear in inverse_depth.
  const Eigen::Vector2d normalised((right_px.x() - calibration.right_cx) / calibration.fx,
                                   (right_px.y() - calibration.cy) / calibration.fy);
  const Eigen::Vector2d slope = shift.head<2>() - normalised * shift.z();
  const Eigen::Vector2d offset = normalised * ray.z() - ray.head<2>();
  Triangulation result{};
  result.inverse_depth = slope.dot(offset) / slope.squaredNorm();
  result.px_per_inverse_depth = calibration.fx * slope.norm();
  const Eigen::Vector2d error =
      right_px - transferToRight(calibration, T_late_camera, left_px, result.inverse_depth);
  result.epipolar_px = error.y() < 0.0 ? -error.norm() : error.norm();
  return result;
}

}  // namespace stereo_nav::vision
