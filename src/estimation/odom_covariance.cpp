#include "stereo_nav/estimation/odom_covariance.h"

namespace stereo_nav::estimation {
namespace {

constexpr double kLeastSigma = 1e-6;  ///< m, rad: what filters can still invert

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
  visitor.real("baseline_sigma_share", baseline_sigma_share, {0.0, 1.0}, "",
               "standard deviation of the calibrated baseline, as a share of it", Change::kLive);
  visitor.real("column_offset_sigma_px", column_offset_sigma_px, {0.0, 100.0}, "px",
               "standard deviation of the right camera's principal point against the left one's",
               Change::kLive);
  visitor.real("distortion_sigma_px", distortion_sigma_px, {0.0, 100.0}, "px",
               "standard deviation of what lens model and rectification leave over", Change::kLive);
  visitor.real("focal_sigma_share", focal_sigma_share, {0.0, 1.0}, "",
               "standard deviation of the focal length, as a share of it", Change::kLive);
  visitor.real("mounting_sigma_rad", mounting_sigma_rad, {0.0, 1.0}, "rad",
               "standard deviation of the left camera's mounting about each axis", Change::kLive);
  visitor.real("lost_speed_m_s", lost_speed_m_s, {0.01, 100.0}, "m/s",
               "standard deviation of the velocity while no motion is measured", Change::kLive);
  visitor.real("lost_turn_rate_rad_s", lost_turn_rate_rad_s, {0.01, 100.0}, "rad/s",
               "standard deviation of the turn rate while no motion is measured", Change::kLive);
}

OdomCovariance::OdomCovariance(const UncertaintyParams& params, const Eigen::Isometry3d& T_base_camera)
    : params_(params), adjoint_base_camera_(adjoint(T_base_camera)) {}

Matrix6d OdomCovariance::start(const Eigen::Matrix3d& R_odom_base, const Matrix6d& pose_covariance,
                               const Matrix6d& pose_noise) {
  const Matrix6d at_least = pose_covariance + diagonal(kLeastSigma, kLeastSigma);
  accumulated_ = turned(R_odom_base.transpose(), at_least) + inBase(pose_noise);
  noise_.setZero();
  effects_.setZero();
  lost_for_s_ = 0.0;
  return pose(R_odom_base);
}

Matrix6d OdomCovariance::addMotion(const odometry::FrameResult& result,
                                   const Eigen::Isometry3d& T_previous_base, double interval_s) {
  if (result.state == odometry::State::kLost || !result.motion_covariance.allFinite()) {
    const Matrix6d before = gap();
    lost_for_s_ += interval_s;
    const Matrix6d covariance = gap() - before;
    if (result.keyframe) {  // a new map: how far the rig has moved meanwhile will never be known
      accumulated_ += gap();
      lost_for_s_ = 0.0;
    }
    return covariance;
  }
  const Effects effect = effects(result);
  const double bent_px = params_.distortion_sigma_px;
  const Matrix6d motion = inBase(result.motion_covariance + bent_px * bent_px * result.covariance_per_px2);
  const Matrix6d carry = adjoint(T_previous_base.inverse());
  const Matrix6d previous_noise = carry * noise_ * carry.transpose();
  noise_ = inBase(result.pose_noise);
  accumulated_ = carry * accumulated_ * carry.transpose() + motion;
  effects_ = carry * effects_ + effect;
  lost_for_s_ = 0.0;
  return previous_noise + motion + noise_ + shared(effect) + diagonal(kLeastSigma, kLeastSigma);
}

Matrix6d OdomCovariance::pose(const Eigen::Matrix3d& R_odom_base) const {
  return turned(R_odom_base, accumulated_ + noise_ + shared(effects_) + gap());
}

Matrix6d OdomCovariance::unknownTwist() const {
  return diagonal(params_.lost_speed_m_s, params_.lost_turn_rate_rad_s);
}

Matrix6d OdomCovariance::inBase(const Matrix6d& covariance) const {
  return adjoint_base_camera_ * covariance * adjoint_base_camera_.transpose();
}

OdomCovariance::Effects OdomCovariance::effects(const odometry::FrameResult& result) const {
  const Eigen::Isometry3d& T_previous_current = result.T_previous_current;
  const Eigen::Vector3d way_m = T_previous_current.linear().transpose() * T_previous_current.translation();
  Effects effects = Effects::Zero();
  effects.block<3, 1>(0, 0) = way_m;
  effects.block<3, 1>(0, 1) = result.scale_per_px * way_m;
  effects(2, 2) = way_m.z();  // depths are wrong by its share, what lies across the view is not
  effects.block<3, 1>(3, 2) = logRotation(T_previous_current.linear());
  effects.rightCols<3>() = (adjoint(T_previous_current.inverse()) - Matrix6d::Identity()).rightCols<3>();
  return adjoint_base_camera_ * effects;
}

Matrix6d OdomCovariance::shared(const Effects& effects) const {
  Eigen::Matrix<double, kShared, 1> sigmas;
  sigmas << params_.baseline_sigma_share, params_.column_offset_sigma_px, params_.focal_sigma_share,
      Eigen::Vector3d::Constant(params_.mounting_sigma_rad);
  const Effects scaled = effects * sigmas.asDiagonal();
  return scaled * scaled.transpose();
}

Matrix6d OdomCovariance::gap() const {
  return lost_for_s_ * lost_for_s_ * unknownTwist();
}

}  // namespace stereo_nav::estimation
