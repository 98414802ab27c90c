#include "stereo_nav/estimation/odom_covariance.h"

namespace stereo_nav::estimation {
namespace {

Matrix6d turned(const Eigen::Matrix3d& R, const Matrix6d& covariance) {
  Matrix6d both = Matrix6d::Zero();
  both.topLeftCorner<3, 3>() = R;
  both.bottomRightCorner<3, 3>() = R;
  return both * covariance * both.transpose();
}

Matrix6d diagonal(double translation_sigma, double rotation_sigma) {
  Vector6d variances;
  variances.head<3>().setConstant(translation_sigma * translation_sigma);
  variances.tail<3>().setConstant(rotation_sigma * rotation_sigma);
  return variances.asDiagonal();
}

}  // namespace

void UncertaintyParams::describe(ParameterVisitor& visitor) {
  visitor.real("min_translation_sigma_m", min_translation_sigma_m, {1e-6, 1.0}, "m",
               "least standard deviation of one frame's translation, each axis", Change::kLive);
  visitor.real("min_rotation_sigma_rad", min_rotation_sigma_rad, {1e-6, 1.0}, "rad",
               "least standard deviation of one frame's rotation, each axis", Change::kLive);
  visitor.real("lost_speed_m_s", lost_speed_m_s, {0.01, 100.0}, "m/s",
               "standard deviation of the velocity while no motion is measured", Change::kLive);
  visitor.real("lost_turn_rate_rad_s", lost_turn_rate_rad_s, {0.01, 100.0}, "rad/s",
               "standard deviation of the turn rate while no motion is measured", Change::kLive);
}

OdomCovariance::OdomCovariance(const UncertaintyParams& params, const Eigen::Isometry3d& T_base_camera)
    : params_(params), adjoint_base_camera_(adjoint(T_base_camera)) {}

Matrix6d OdomCovariance::start(const Eigen::Matrix3d& R_odom_base, const Matrix6d& pose_covariance) {
  Matrix6d at_least =
      pose_covariance + diagonal(params_.min_translation_sigma_m, params_.min_rotation_sigma_rad);
  pose_in_base_ = turned(R_odom_base.transpose(), at_least);
  return at_least;
}

Matrix6d OdomCovariance::addMotion(const odometry::FrameResult& result,
                                   const Eigen::Isometry3d& T_previous_base, double interval_s) {
  Matrix6d covariance = motion(result, interval_s);
  const Matrix6d carry = adjoint(T_previous_base.inverse());
  pose_in_base_ = carry * pose_in_base_ * carry.transpose() + covariance;
  return covariance;
}

Matrix6d OdomCovariance::pose(const Eigen::Matrix3d& R_odom_base) const {
  return turned(R_odom_base, pose_in_base_);
}

Matrix6d OdomCovariance::unknownTwist() const {
  return diagonal(params_.lost_speed_m_s, params_.lost_turn_rate_rad_s);
}

Matrix6d OdomCovariance::motion(const odometry::FrameResult& result, double interval_s) const {
  if (result.state == odometry::State::kLost || !result.motion_covariance.allFinite()) {
    return diagonal(params_.lost_speed_m_s * interval_s, params_.lost_turn_rate_rad_s * interval_s);
  }
  return adjoint_base_camera_ * result.motion_covariance * adjoint_base_camera_.transpose() +
         diagonal(params_.min_translation_sigma_m, params_.min_rotation_sigma_rad);
}

}  // namespace stereo_nav::estimation
