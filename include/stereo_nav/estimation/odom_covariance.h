#pragma once

#include <Eigen/Geometry>

#include "stereo_nav/core/lie.h"
#include "stereo_nav/core/parameter_visitor.h"
#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::estimation {

/// Lower bounds of the uncertainty of a measured motion, and the uncertainty while no motion is measured.
struct UncertaintyParams {
  double min_translation_sigma_m = 0.001;  ///< per frame and axis
  double min_rotation_sigma_rad = 0.0005;  ///< per frame and axis
  double lost_speed_m_s = 1.0;             ///< while no motion is measured
  double lost_turn_rate_rad_s = 1.0;       ///< while no motion is measured

  /// Names, ranges and meanings of the parameters.
  void describe(ParameterVisitor& visitor);
};

/// The covariances that the `odom` topic carries, in the order x y z, then rotation about x y z.
///
/// First model of the uncertainty: each measured motion has the covariance that the odometry gives it, plus
/// the floor of the parameters. A frame without a motion means an unknown velocity of `lost_speed_m_s` and
/// `lost_turn_rate_rad_s` (one sigma) since the frame before. The covariance of the pose is the sum over all
/// motions, carried along by the adjoint (Sola et al., "A micro Lie theory", eq. 54); that of the twist is
/// the covariance of the last motion divided by its duration squared.
class OdomCovariance {
 public:
  /// `T_base_camera` takes camera coordinates into those of the base.
  OdomCovariance(const UncertaintyParams& params, const Eigen::Isometry3d& T_base_camera);

  /// Sets the parameters for all later motions.
  void setUncertainty(const UncertaintyParams& params) { params_ = params; }

  /// The pose is known with this covariance (axes of odom). Returns it with the floor of one motion added: it
  /// is never zero, since filters invert it.
  Matrix6d start(const Eigen::Matrix3d& R_odom_base, const Matrix6d& pose_covariance);

  /// Adds the motion T_previous_base that a frame's `result` tells of, `interval_s` after the frame before.
  /// Returns the covariance of that motion, axes of the base after it.
  Matrix6d addMotion(const odometry::FrameResult& result, const Eigen::Isometry3d& T_previous_base,
                     double interval_s);

  /// Covariance of the pose, axes of odom.
  Matrix6d pose(const Eigen::Matrix3d& R_odom_base) const;

  /// Covariance of the twist while no motion is measured, axes of the base.
  Matrix6d unknownTwist() const;

 private:
  Matrix6d motion(const odometry::FrameResult& result, double interval_s) const;

  UncertaintyParams params_;
  Matrix6d adjoint_base_camera_;
  Matrix6d pose_in_base_ = Matrix6d::Zero();  ///< covariance of the pose, axes of the base
};

}  // namespace stereo_nav::estimation
