#include "odometry/laser/pose_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/planar_motion.h"

namespace stereo_nav::odometry {
namespace {

/// Noise of measured rates that no motion causes: resolution and vibration, m and rad in the root of 1 s.
constexpr double kStill_m = 0.003;
constexpr double kStill_rad = 0.003;
/// What scales and biases wander by in the root of 1 s.
constexpr double kScaleWalk = 0.002;
constexpr double kBiasWalk_rad_per_s = 3e-4;
/// Velocities of the start and after a source was lost.
constexpr double kUnknownSpeed_m_per_s = 0.5;
constexpr double kUnknownTurn_rad_per_s = 1.0;
/// Without a scan for so long, a velocity that nothing measures is no longer believed.
constexpr double kCoast_s = 0.6;
/// In which a robot that nothing sees comes to rest.
constexpr double kRest_s = 0.5;

/// Noise is judged while the robot moves, a tenth of the contradiction a scan, a single one for no more than
/// kMostRatio.
constexpr double kMoving_m_per_s = 0.03;
constexpr double kMoving_rad_per_s = 0.05;
constexpr double kLearning = 0.1;
constexpr double kMostRatio = 10.0;
constexpr double kLeastNoise = 0.05;
constexpr double kLeastRotationNoise = 0.5;
constexpr double kMostNoise = 1000.0;

/// What turns the pose turns the step (axes of odom).
Matrix9d errorsAfter(const Eigen::Vector2d& step) {
  Matrix9d F = Matrix9d::Identity();
  for (const Eigen::Index i : {0, 3}) {
    F(i, i + 2) = -step.y();
    F(i + 1, i + 2) = step.x();
  }
  return F;
}

}  // namespace

Eigen::Isometry2d PlanarState::T_odom_base() const {
  Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
  T.linear() = Eigen::Rotation2Dd(yaw_rad).toRotationMatrix();
  T.translation() = p_odom;
  return T;
}

PoseFilter::PoseFilter(const LaserParams& params) : params_(params) {
  setCorrection(0, 0.0, kUnknownSpeed_m_per_s);
  setCorrection(1, 0.0, kUnknownSpeed_m_per_s);
  setCorrection(2, 0.0, kUnknownTurn_rad_per_s);
}

Eigen::Matrix3d PoseFilter::poseCovariance() const {
  const Eigen::Matrix3d ad = covariance_.block<3, 3>(0, 3);
  return covariance_.topLeftCorner<3, 3>() + covariance_.block<3, 3>(3, 3) + ad + ad.transpose();
}

void PoseFilter::setPose(const Eigen::Isometry2d& T_odom_base, const Eigen::Matrix3d& covariance) {
  state_.p_odom = T_odom_base.translation();
  state_.yaw_rad = yawOf(T_odom_base);
  covariance_.topRows<6>().setZero();
  covariance_.leftCols<6>().setZero();
  covariance_.topLeftCorner<3, 3>() = covariance;
}

void PoseFilter::setCorrection(Eigen::Index axis, double value, double sigma) {
  const Eigen::Index i = 6 + axis;
  state_.correction(axis) = value;
  covariance_.row(i).setZero();
  covariance_.col(i).setZero();
  covariance_(i, i) = sigma * sigma;
}

void PoseFilter::changeSources(RateSource translation, RateSource rotation) {
  if (translation != translation_) {
    translation_ = translation;
    const bool wheels = translation == RateSource::kWheels;
    for (Eigen::Index axis = 0; axis < 2; ++axis)
      setCorrection(axis, wheels ? 0.0 : last_rate_(axis),
                    wheels ? params_.wheel_scale_sigma : kUnknownSpeed_m_per_s);
  }
  if (rotation == rotation_) return;
  rotation_ = rotation;
  if (rotation == RateSource::kGyro) setCorrection(2, 0.0, params_.gyro_bias_sigma_rad_per_s);
  if (rotation == RateSource::kWheels) setCorrection(2, 0.0, params_.wheel_scale_sigma);
  if (rotation == RateSource::kNone) setCorrection(2, last_rate_.z(), kUnknownTurn_rad_per_s);
}

CorrectedRate PoseFilter::corrected(const MeasuredMotion& motion, const RatePiece& piece,
                                    const Eigen::Vector3d& correction) const {
  CorrectedRate result{piece.rate, Eigen::Vector3d::Ones()};
  if (motion.translation == RateSource::kWheels) result.gain.head<2>() = piece.rate.head<2>();
  if (motion.rotation == RateSource::kWheels) result.gain.z() = piece.rate.z();
  result.rate += result.gain.cwiseProduct(correction);
  if (motion.translation != translation_) {
    result.rate.head<2>() = last_rate_.head<2>();
    result.gain.head<2>().setZero();
  }
  if (motion.rotation != rotation_) {
    result.rate.z() = last_rate_.z();
    result.gain.z() = 0.0;
  }
  return result;
}

Eigen::Vector3d PoseFilter::rateNoise(const Eigen::Vector3d& rate) const {
  const double speed_m_per_s = rate.head<2>().norm();
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();  // of one second
  if (translation_ == RateSource::kWheels)
    variance.head<2>().setConstant(kStill_m * kStill_m +
                                   std::pow(params_.wheel_slip_sigma, 2) * speed_m_per_s);
  if (rotation_ == RateSource::kWheels)
    variance.z() = kStill_rad * kStill_rad +
                   std::pow(params_.wheel_turn_sigma, 2) * (speed_m_per_s + std::abs(rate.z()));
  if (rotation_ == RateSource::kGyro) variance.z() = std::pow(params_.gyro_sigma_rad, 2);
  variance.head<2>() *= translation_noise_;
  variance.z() *= rotation_noise_;
  return variance;
}

Eigen::Vector3d PoseFilter::correctionWalk() const {
  const bool wheels = translation_ == RateSource::kWheels;
  const double along = wheels ? kScaleWalk : params_.acceleration_sigma_m_per_s2;
  double turn = kScaleWalk;
  if (rotation_ == RateSource::kNone) turn = params_.turn_acceleration_sigma_rad_per_s2;
  if (rotation_ == RateSource::kGyro) turn = kBiasWalk_rad_per_s;
  return Eigen::Vector3d(along * along, along * along, turn * turn)
      .cwiseProduct(Eigen::Vector3d(wheels ? 1.0 : translation_noise_, wheels ? 1.0 : translation_noise_,
                                    rotation_ == RateSource::kNone ? rotation_noise_ : 1.0));
}

void PoseFilter::transform(const Matrix9d& F) {
  covariance_ = (F * covariance_ * F.transpose()).eval();
  transition_ = (F * transition_).eval();
}

void PoseFilter::predict(const MeasuredMotion& motion, double unseen_s) {
  changeSources(motion.translation, motion.rotation);
  for (const RatePiece& piece : motion.pieces) {
    const double dt = piece.duration_s;
    unseen_s += dt;
    if (unseen_s > kCoast_s) {
      const double keep = std::exp(-dt / kRest_s);
      if (translation_ == RateSource::kNone) state_.correction.head<2>() *= keep;
      if (rotation_ == RateSource::kNone) state_.correction.z() *= keep;
    }
    const CorrectedRate rates = corrected(motion, piece, state_.correction);
    last_rate_ = rates.rate;
    const Eigen::Matrix2d R =
        Eigen::Rotation2Dd(state_.yaw_rad + 0.5 * dt * rates.rate.z()).toRotationMatrix();
    const Eigen::Vector2d step = dt * R * rates.rate.head<2>();
    state_.p_odom += step;
    state_.yaw_rad += dt * rates.rate.z();
    Matrix9d F = errorsAfter(step);
    F.block<2, 2>(3, 6) = dt * R * rates.gain.head<2>().asDiagonal();
    F(5, 8) = dt * rates.gain.z();
    transform(F);
    const Eigen::Vector3d noise = dt * rateNoise(rates.rate);
    covariance_.block<2, 2>(3, 3) += R * noise.head<2>().asDiagonal() * R.transpose();
    covariance_(5, 5) += noise.z();
    covariance_.bottomRightCorner<3, 3>().diagonal() += dt * correctionWalk();
  }
}

void PoseFilter::move(const Eigen::Isometry2d& T_before_now, const Eigen::Matrix3d& covariance) {
  const Eigen::Vector2d step = Eigen::Rotation2Dd(state_.yaw_rad) * T_before_now.translation();
  state_.p_odom += step;
  state_.yaw_rad += yawOf(T_before_now);
  transform(errorsAfter(step));
  covariance_.block<3, 3>(3, 3) += inAxesOf(state_.T_odom_base(), covariance);
}

void PoseFilter::judgeNoise(const Vector6d& shift, const Matrix6d& covariance, bool all_told) {
  const bool moves =
      last_rate_.head<2>().norm() > kMoving_m_per_s || std::abs(last_rate_.z()) > kMoving_rad_per_s;
  if (!all_told || !moves) return;
  // A shift varies by what the scan takes from the variance of the prior.
  const Eigen::Matrix3d expected = covariance_.block<3, 3>(3, 3) - covariance.topLeftCorner<3, 3>();
  const auto learn = [](double squared, double variance, double least, double& factor) {
    const double ratio = std::min(kMostRatio, squared / std::max(variance, 1e-12));
    factor = std::clamp(factor * std::exp(kLearning * (ratio - 1.0)), least, kMostNoise);
  };
  learn(shift.head<2>().squaredNorm(), expected(0, 0) + expected(1, 1), kLeastNoise, translation_noise_);
  learn(shift(2) * shift(2), expected(2, 2), kLeastRotationNoise, rotation_noise_);
}

void PoseFilter::distrustPrior(double factor) {
  covariance_.block<3, 3>(3, 3) *= factor;
}

void PoseFilter::update(const Vector6d& shift, const Matrix6d& covariance, const Matrix6d& contraction) {
  state_.p_odom += shift.head<2>();
  state_.yaw_rad += shift(2);
  state_.correction += shift.tail<3>();
  Matrix9d F = Matrix9d::Identity();
  F.bottomRightCorner<6, 6>() = contraction;
  transition_ = (F * transition_).eval();
  covariance_.topRightCorner<3, 6>() = (covariance_.topRightCorner<3, 6>() * contraction.transpose()).eval();
  covariance_.bottomLeftCorner<6, 3>() = covariance_.topRightCorner<3, 6>().transpose();
  covariance_.bottomRightCorner<6, 6>() = covariance;
  last_rate_ += Eigen::Vector3d(translation_ == RateSource::kNone ? shift(3) : 0.0,
                                translation_ == RateSource::kNone ? shift(4) : 0.0,
                                rotation_ == RateSource::kNone ? shift(5) : 0.0);
}

void PoseFilter::mixIntoMap(double share, const Eigen::Matrix3d& noise) {
  Matrix9d F = Matrix9d::Identity();
  F.block<3, 3>(0, 3) = share * Eigen::Matrix3d::Identity();
  F.block<3, 3>(3, 3) = (1.0 - share) * Eigen::Matrix3d::Identity();
  transform(F);
  const Eigen::Matrix3d added = share * share * noise;
  covariance_.block<3, 3>(0, 0) += added;
  covariance_.block<3, 3>(3, 3) += added;
  covariance_.block<3, 3>(0, 3) -= added;
  covariance_.block<3, 3>(3, 0) -= added;
}

}  // namespace stereo_nav::odometry
