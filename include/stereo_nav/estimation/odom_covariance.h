#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "stereo_nav/core/lie.h"
#include "stereo_nav/core/parameter_visitor.h"
#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::estimation {

/// What the calibration is uncertain by, which all frames share, and the uncertainty while no motion is
/// measured.
struct UncertaintyParams {
  double baseline_sigma_share = 0.001;  ///< of the distance between the cameras, as a share of it
  double column_offset_sigma_px = 0.1;  ///< of the right camera's principal point
  double distortion_sigma_px = 0.2;     ///< of what lens model and rectification leave over
  double focal_sigma_share = 0.001;     ///< of the focal length: depths and turns are wrong by this share
  double mounting_sigma_rad = 0.003;    ///< of the left camera's axes in base_link, about each
  double lost_speed_m_s = 1.0;          ///< while no motion is measured
  double lost_turn_rate_rad_s = 1.0;    ///< while no motion is measured

  /// Names, ranges and meanings of the parameters.
  void describe(ParameterVisitor& visitor);
};

/// The covariances that the `odom` topic carries, in the order x y z, then rotation about x y z.
///
/// The error of a pose has three parts. Each motion adds noise that is independent of that of all others
/// (FrameResult::motion_covariance), carried along by the adjoint (Sola et al., "A micro Lie theory", eq.
/// 54). The newest pose has noise of its own (pose_noise). Errors of the calibration are the same in all
/// motions: their effects add up, not their variances, so that they grow with the distance and not with its
/// root.
///
/// While no motion is measured (the gap), a coasting pose has the covariance that the odometry predicts;
/// after that the velocity is unknown, the same one all the time: as large as `lost_speed_m_s` and the last
/// one measured. A pose that is found again against the same map is as well known as before. One of a new map
/// keeps the uncertainty of the gap, with the larger one of the velocities before and after. The first motion
/// of a map counts from when a second one has confirmed it.
class OdomCovariance {
 public:
  /// `T_base_camera` takes camera coordinates into those of the base.
  OdomCovariance(const UncertaintyParams& params, const Eigen::Isometry3d& T_base_camera);

  /// Sets the parameters for all later motions.
  void setUncertainty(const UncertaintyParams& params) { params_ = params; }

  /// The pose is known with this covariance (axes of odom). Returns it with a sigma of 1e-6 m and 1e-6 rad
  /// added: it is never zero, since filters invert it. `pose_noise` is FrameResult::pose_noise of the frame
  /// at which the counting starts; it stays part of all later covariances.
  Matrix6d start(const Eigen::Matrix3d& R_odom_base, const Matrix6d& pose_covariance,
                 const Matrix6d& pose_noise = Matrix6d::Zero());

  /// Adds the motion T_previous_base that a frame's `result` tells of, `interval_s` after the frame before.
  /// Returns the covariance of that motion, axes of the base after it; that of a first motion is unknown
  /// until it is confirmed.
  Matrix6d addMotion(const odometry::FrameResult& result, const Eigen::Isometry3d& T_previous_base,
                     double interval_s);

  /// Covariance of the pose, axes of odom.
  Matrix6d pose(const Eigen::Matrix3d& R_odom_base) const;

  /// Covariance of the twist while nothing is known of it, axes of the base.
  Matrix6d unknownTwist() const;

 private:
  /// Unit errors of the calibration: baseline, focal length, mounting about each axis, and those of
  /// odometry::CalibrationEffects, of which the first is the column offset and the others are the lenses'.
  enum { kBaseline, kFocal, kMounting, kColumnOffset = kMounting + 3 };
  static constexpr int kShared = kColumnOffset + odometry::CalibrationEffects::ColsAtCompileTime;
  using Effects = Eigen::Matrix<double, 6, kShared>;

  /// A measured motion.
  struct Motion {
    Eigen::Isometry3d T_previous_base = Eigen::Isometry3d::Identity();
    Matrix6d covariance = Matrix6d::Zero();
    Matrix6d pose_noise = Matrix6d::Zero();
    Effects effects = Effects::Zero();
  };
  /// What has happened since the last pose that was measured and confirmed.
  struct Gap {
    Eigen::Isometry3d way = Eigen::Isometry3d::Identity();  ///< predicted
    Matrix6d before = Matrix6d::Zero();                     ///< of the predictions that ended with a new map
    Matrix6d predicted = Matrix6d::Zero();                  ///< of the one since
    double predicted_for_s = 0.0;
    double unknown_for_s = 0.0;
    bool turn_is_measured = false;
    bool new_map = false;
    std::vector<Motion> unconfirmed;  ///< of the new map
    double unconfirmed_for_s = 0.0;
  };

  Motion motionOf(const odometry::FrameResult& result, const Eigen::Isometry3d& T_previous_base) const;
  void add(const Motion& motion);
  Matrix6d addGap(const odometry::FrameResult& result, const Eigen::Isometry3d& T_previous_base,
                  double interval_s);
  /// The rig goes on from a new map: how far it moved in the gap will never be known.
  void keepGap();
  Matrix6d inBase(const Matrix6d& covariance) const;
  Effects effects(const odometry::FrameResult& result) const;
  Matrix6d shared(const Effects& effects) const;
  Matrix6d gapCovariance() const;

  UncertaintyParams params_;
  Matrix6d adjoint_base_camera_;
  // All in the axes of the base.
  Matrix6d accumulated_ = Matrix6d::Zero();  ///< noise of all motions
  Matrix6d noise_ = Matrix6d::Zero();        ///< of the newest measured pose
  Effects effects_ = Effects::Zero();        ///< of unit errors of the calibration on the pose
  Vector6d last_twist_ = Vector6d::Zero();   ///< the last one measured
  Gap gap_;
};

}  // namespace stereo_nav::estimation
