#include "mapping/mono/mono_base.h"

#include "core/base_pose.h"

namespace stereo_nav::mapping {

UncertainBase basePoseOf(const MonoResult& result, const Eigen::Isometry3d& T_base_camera) {
  UncertainBase base;
  base.T_odom_base = basePose(T_base_camera, result.camera.T_world_camera());
  // The base is a lever's length from the camera: its place moves when the camera turns.
  const Eigen::Vector3d lever_world = result.camera.q_world_camera * T_base_camera.inverse().translation();
  Matrix6d carry = Matrix6d::Identity();
  carry.topRightCorner<3, 3>() = -hat(lever_world);
  base.covariance = turned(T_base_camera.linear(), carry * result.pose_covariance * carry.transpose());
  return base;
}

Matrix6d atBase(const Matrix6d& camera_covariance, const Eigen::Isometry3d& T_base_camera) {
  const Matrix6d carry = adjoint(T_base_camera);
  return carry * camera_covariance * carry.transpose();
}

}  // namespace stereo_nav::mapping
