#include "stereo_nav/estimation/base_odometry.h"

#include "core/base_pose.h"

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

BaseOdometry::BaseOdometry(const UncertaintyParams& params, const Eigen::Isometry3d& T_base_camera)
    : params_(params), T_base_camera_(T_base_camera), adjoint_base_camera_(adjoint(T_base_camera)) {
  start(Eigen::Isometry3d::Identity(), Matrix6d::Zero());
}

void BaseOdometry::start(const Eigen::Isometry3d& T_odom_base, const Matrix6d& pose_covariance) {
  T_start_base_.setIdentity();
  previous_time_s_.reset();
  previous_lost_ = false;
  setPose(T_odom_base, pose_covariance);
  estimate_.twist.setZero();
  estimate_.twist_covariance = diagonal(params_.lost_speed_m_s, params_.lost_turn_rate_rad_s);
}

void BaseOdometry::setPose(const Eigen::Isometry3d& T_odom_base, const Matrix6d& pose_covariance) {
  T_odom_start_ = T_odom_base * T_start_base_.inverse();
  // The covariance is never exactly zero, since filters invert it.
  const Matrix6d at_least =
      pose_covariance + diagonal(params_.min_translation_sigma_m, params_.min_rotation_sigma_rad);
  covariance_base_ = turned(T_odom_base.linear().transpose(), at_least);
  estimate_.T_odom_base = T_odom_base;
  estimate_.pose_covariance = at_least;
}

const BaseEstimate& BaseOdometry::update(const odometry::FrameResult& result, double time_s) {
  T_start_base_ = basePose(T_base_camera_, result.T_start_camera);
  estimate_.T_odom_base = T_odom_start_ * T_start_base_;
  if (previous_time_s_) addMotion(result, time_s - *previous_time_s_, !previous_lost_);
  estimate_.pose_covariance = turned(estimate_.T_odom_base.linear(), covariance_base_);
  previous_time_s_ = time_s;
  previous_lost_ = result.state == odometry::State::kLost;
  return estimate_;
}

void BaseOdometry::addMotion(const odometry::FrameResult& result, double interval_s,
                             bool measured_from_previous_frame) {
  const Matrix6d covariance = motionCovariance(result, interval_s);
  const Eigen::Isometry3d motion = basePose(T_base_camera_, result.T_previous_camera);
  const Matrix6d carry = adjoint(motion.inverse());
  covariance_base_ = carry * covariance_base_ * carry.transpose() + covariance;

  // After lost frames the motion may span more than the last interval, so that its speed is unknown.
  const bool known = result.state != odometry::State::kLost && measured_from_previous_frame;
  estimate_.twist = known ? Vector6d(logMotion(motion) / interval_s) : Vector6d::Zero();
  estimate_.twist_covariance = known ? Matrix6d(covariance / (interval_s * interval_s))
                                     : diagonal(params_.lost_speed_m_s, params_.lost_turn_rate_rad_s);
}

Matrix6d BaseOdometry::motionCovariance(const odometry::FrameResult& result, double interval_s) const {
  if (result.state == odometry::State::kLost || !result.motion_covariance.allFinite()) {
    return diagonal(params_.lost_speed_m_s * interval_s, params_.lost_turn_rate_rad_s * interval_s);
  }
  return adjoint_base_camera_ * result.motion_covariance * adjoint_base_camera_.transpose() +
         diagonal(params_.min_translation_sigma_m, params_.min_rotation_sigma_rad);
}

}  // namespace stereo_nav::estimation
