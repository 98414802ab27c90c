#pragma once

#include <Eigen/Geometry>

#include "odometry/laser/laser_params.h"
#include "odometry/laser/measured_motion.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::odometry {

using Matrix9d = Eigen::Matrix<double, 9, 9>;

/// What is estimated: the pose and, for each axis of the base, what the measured rates are off by.
struct PlanarState {
  Eigen::Vector2d p_odom = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;  ///< does not wrap
  /// The scale error of wheels, the bias of a gyroscope (rad/s), or the velocity itself where nothing
  /// measures the axis (m/s, rad/s).
  Eigen::Vector3d correction = Eigen::Vector3d::Zero();

  Eigen::Isometry2d T_odom_base() const;
};

/// The rates of the base in one piece, and what the correction changes them by.
struct CorrectedRate {
  Eigen::Vector3d rate;  ///< forward m/s, left m/s, rad/s
  Eigen::Vector3d gain;  ///< d rate / d correction
};

/// Carries the pose along wheels and gyroscope, and its covariance with it. Nine errors are kept, in this
/// order: `a`, by which the map has drifted; `d`, by which the pose is off in the map; `c`, of the
/// correction. `a` and `d` are errors (m, m, rad) of the pose of the base in the axes of odom; that of the
/// pose in odom is their sum. A scan measures d alone. Whatever moves the robot moves the place that a and d
/// are taken at.
class PoseFilter {
 public:
  explicit PoseFilter(const LaserParams& params);

  const PlanarState& state() const { return state_; }
  const Matrix9d& covariance() const { return covariance_; }
  /// Of the pose in odom, axes of odom.
  Eigen::Matrix3d poseCovariance() const;
  /// Of d and c.
  Matrix6d relativeCovariance() const { return covariance_.bottomRightCorner<6, 6>(); }
  /// Takes the nine errors before the last beginStep() to those of now.
  const Matrix9d& transition() const { return transition_; }

  void setPose(const Eigen::Isometry2d& T_odom_base, const Eigen::Matrix3d& covariance);
  void beginStep() { transition_.setIdentity(); }
  /// Moves on. `unseen_s`: how long ago a scan has held the velocity. What nothing measures comes to rest.
  void predict(const MeasuredMotion& motion, double unseen_s);
  /// Moves on as something else has measured it, with the covariance of that motion in the axes of the base.
  void move(const Eigen::Isometry2d& T_before_now, const Eigen::Matrix3d& covariance);
  /// Before update(): learns from the shift how noisy wheels and gyroscope are, compared with the parameters.
  void judgeNoise(const Vector6d& shift, const Matrix6d& covariance, bool all_told);
  /// `shift` of d and c by a scan, their covariance after it, and what takes their errors before it to those
  /// after it, but for the scan's own.
  void update(const Vector6d& shift, const Matrix6d& covariance, const Matrix6d& contraction);
  /// The prior contradicts a scan that fits: its variance is so much larger.
  void distrustPrior(double factor);
  /// A scan of this noise (of its pose, axes of odom) has become this share of the map: its pose's error is
  /// the map's, so far.
  void mixIntoMap(double share, const Eigen::Matrix3d& noise);
  /// The map begins anew at the present pose.
  void restartMap() { mixIntoMap(1.0, Eigen::Matrix3d::Zero()); }

  /// Where sources are missing that the filter runs on, the last rate goes on.
  CorrectedRate corrected(const MeasuredMotion& motion, const RatePiece& piece,
                          const Eigen::Vector3d& correction) const;
  const Eigen::Vector3d& lastRate() const { return last_rate_; }

 private:
  void changeSources(RateSource translation, RateSource rotation);
  void setCorrection(Eigen::Index axis, double value, double sigma);
  Eigen::Vector3d rateNoise(const Eigen::Vector3d& rate) const;
  Eigen::Vector3d correctionWalk() const;
  void transform(const Matrix9d& F);

  LaserParams params_;
  PlanarState state_;
  Matrix9d covariance_ = Matrix9d::Zero();
  Matrix9d transition_ = Matrix9d::Identity();
  RateSource translation_ = RateSource::kNone;
  RateSource rotation_ = RateSource::kNone;
  Eigen::Vector3d last_rate_ = Eigen::Vector3d::Zero();
  double translation_noise_ = 1.0;  ///< by which the variance of the sources is multiplied
  double rotation_noise_ = 1.0;
};

}  // namespace stereo_nav::odometry
