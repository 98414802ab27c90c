#include "stereo_nav/estimation/odom_covariance.h"

#include <cmath>
#include <utility>

namespace stereo_nav::estimation {
namespace {

constexpr double kLeastSigma = 1e-6;  ///< m, rad: what filters can still invert

Matrix6d diagonal(double translation_sigma, double rotation_sigma) {
  Vector6d variances;
  variances.head<3>().setConstant(translation_sigma * translation_sigma);
  variances.tail<3>().setConstant(rotation_sigma * rotation_sigma);
  return variances.asDiagonal();
}

/// Of each of the two kinds the faster one.
Vector6d larger(const Vector6d& a, const Vector6d& b) {
  Vector6d result;
  result << (a.head<3>().norm() > b.head<3>().norm() ? a : b).head<3>(),
      (a.tail<3>().norm() > b.tail<3>().norm() ? a : b).tail<3>();
  return result;
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
  visitor.real(
      "lost_speed_m_s", lost_speed_m_s, {0.01, 100.0}, "m/s",
      "standard deviation of the velocity of a robot at rest that is lost; a moving one has that of its "
      "last velocity besides",
      Change::kLive);
  visitor.real("lost_turn_rate_rad_s", lost_turn_rate_rad_s, {0.01, 100.0}, "rad/s",
               "likewise of the turn rate, where no IMU measures it", Change::kLive);
}

OdomCovariance::OdomCovariance(const UncertaintyParams& params, const Eigen::Isometry3d& T_base_camera)
    : params_(params), adjoint_base_camera_(adjoint(T_base_camera)) {}

Matrix6d OdomCovariance::start(const Eigen::Matrix3d& R_odom_base, const Matrix6d& pose_covariance,
                               const Matrix6d& pose_noise) {
  const Matrix6d at_least = pose_covariance + diagonal(kLeastSigma, kLeastSigma);
  accumulated_ = turned(R_odom_base.transpose(), at_least) + inBase(pose_noise);
  noise_.setZero();
  effects_.setZero();
  last_twist_.setZero();
  gap_ = Gap();
  return pose(R_odom_base);
}

Matrix6d OdomCovariance::addMotion(const odometry::FrameResult& result,
                                   const Eigen::Isometry3d& T_previous_base, double interval_s) {
  if (!odometry::isMeasured(result.state) || result.new_map || !result.motion_covariance.allFinite())
    return addGap(result, T_previous_base, interval_s);
  const Motion motion = motionOf(result, T_previous_base);
  if (result.state == odometry::State::kInitialising) {
    gap_.unconfirmed.push_back(motion);
    gap_.unconfirmed_for_s += interval_s;
    return interval_s * interval_s * unknownTwist();
  }
  const bool follows = gap_.predicted_for_s + gap_.unknown_for_s == 0.0 || gap_.new_map;
  if (follows)
    last_twist_ = gap_.new_map ? larger(last_twist_, logMotion(T_previous_base) / interval_s)
                               : Vector6d(logMotion(T_previous_base) / interval_s);
  if (gap_.new_map) keepGap();
  for (const Motion& earlier : gap_.unconfirmed) add(earlier);
  gap_ = Gap();
  const Matrix6d carry = adjoint(T_previous_base.inverse());
  const Matrix6d previous_noise = carry * noise_ * carry.transpose();
  add(motion);
  return previous_noise + motion.covariance + noise_ + shared(motion.effects) +
         diagonal(kLeastSigma, kLeastSigma);
}

OdomCovariance::Motion OdomCovariance::motionOf(const odometry::FrameResult& result,
                                                const Eigen::Isometry3d& T_previous_base) const {
  return {T_previous_base, inBase(result.motion_covariance), inBase(result.pose_noise), effects(result)};
}

void OdomCovariance::add(const Motion& motion) {
  const Matrix6d carry = adjoint(motion.T_previous_base.inverse());
  noise_ = motion.pose_noise;
  accumulated_ = carry * accumulated_ * carry.transpose() + motion.covariance;
  effects_ = carry * effects_ + motion.effects;
}

Matrix6d OdomCovariance::addGap(const odometry::FrameResult& result, const Eigen::Isometry3d& T_previous_base,
                                double interval_s) {
  const Matrix6d before = gapCovariance();
  // Motions that were not confirmed have not happened.
  Eigen::Isometry3d step = T_previous_base;
  for (auto motion = gap_.unconfirmed.rbegin(); motion != gap_.unconfirmed.rend(); ++motion)
    step = motion->T_previous_base * step;
  gap_.unconfirmed.clear();
  const double elapsed_s = interval_s + std::exchange(gap_.unconfirmed_for_s, 0.0);

  const Matrix6d carry = adjoint(step.inverse());
  gap_.way = gap_.way * step;
  gap_.before = carry * gap_.before * carry.transpose();
  gap_.predicted = inBase(result.motion_covariance.allFinite() ? result.motion_covariance : Matrix6d::Zero());
  gap_.turn_is_measured = result.turn_is_measured;
  const bool coasts = result.state == odometry::State::kCoasting;
  (coasts ? gap_.predicted_for_s : gap_.unknown_for_s) += elapsed_s;
  const Matrix6d covariance = gapCovariance();
  const double share = interval_s / gap_.predicted_for_s;
  if (result.new_map) {
    gap_.before += std::exchange(gap_.predicted, Matrix6d::Zero());
    gap_.predicted_for_s = 0.0;
    gap_.new_map = true;
  }
  // A velocity whose error grew as a position's did has at most three times the variance that made it.
  return coasts ? Matrix6d(3.0 * share * share * gap_.predicted) : Matrix6d(covariance - before);
}

void OdomCovariance::keepGap() {
  const Matrix6d carry = adjoint(gap_.way.inverse());
  accumulated_ = carry * (accumulated_ + noise_) * carry.transpose() + gapCovariance();
  effects_ = carry * effects_;
  noise_.setZero();
}

Matrix6d OdomCovariance::pose(const Eigen::Matrix3d& R_odom_base) const {
  const Matrix6d carry = adjoint(gap_.way.inverse());
  const Matrix6d measured = accumulated_ + noise_ + shared(effects_);
  const Matrix6d unconfirmed = gap_.unconfirmed_for_s * gap_.unconfirmed_for_s * unknownTwist();
  return turned(R_odom_base, carry * measured * carry.transpose() + gapCovariance() + unconfirmed);
}

Matrix6d OdomCovariance::unknownTwist() const {
  return diagonal(std::hypot(params_.lost_speed_m_s, last_twist_.head<3>().norm()),
                  std::hypot(params_.lost_turn_rate_rad_s, last_twist_.tail<3>().norm()));
}

Matrix6d OdomCovariance::inBase(const Matrix6d& covariance) const {
  return adjoint_base_camera_ * covariance * adjoint_base_camera_.transpose();
}

OdomCovariance::Effects OdomCovariance::effects(const odometry::FrameResult& result) const {
  const Eigen::Isometry3d& T_previous_current = result.T_previous_current;
  const Eigen::Vector3d way_m = T_previous_current.linear().transpose() * T_previous_current.translation();
  Effects effects = Effects::Zero();
  effects.block<3, 1>(0, kBaseline) = way_m;
  effects(2, kFocal) = way_m.z();  // depths are wrong by its share, what lies across the view is not
  effects.block<3, 1>(3, kFocal) = logRotation(T_previous_current.linear());
  effects.middleCols<3>(kMounting) =
      (adjoint(T_previous_current.inverse()) - Matrix6d::Identity()).rightCols<3>();
  effects.rightCols<odometry::CalibrationEffects::ColsAtCompileTime>() = result.calibration_effects;
  return adjoint_base_camera_ * effects;
}

Matrix6d OdomCovariance::shared(const Effects& effects) const {
  Eigen::Matrix<double, kShared, 1> sigmas;
  sigmas.setConstant(params_.distortion_sigma_px);
  sigmas(kBaseline) = params_.baseline_sigma_share;
  sigmas(kFocal) = params_.focal_sigma_share;
  sigmas.segment<3>(kMounting).setConstant(params_.mounting_sigma_rad);
  sigmas(kColumnOffset) = params_.column_offset_sigma_px;
  const Effects scaled = effects * sigmas.asDiagonal();
  return scaled * scaled.transpose();
}

Matrix6d OdomCovariance::gapCovariance() const {
  Matrix6d unknown = gap_.unknown_for_s * gap_.unknown_for_s * unknownTwist();
  if (gap_.turn_is_measured) unknown.bottomRightCorner<3, 3>().setZero();
  return gap_.before + gap_.predicted + unknown;
}

}  // namespace stereo_nav::estimation
