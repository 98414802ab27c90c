#pragma once

#include <Eigen/Geometry>
#include <optional>

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

/// Pose and velocity of the base in the conventions of nav_msgs/Odometry. Covariances have the order x y z,
/// then rotation about x y z.
struct BaseEstimate {
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();  ///< pose of base_link in odom
  Matrix6d pose_covariance = Matrix6d::Zero();                    ///< axes of odom
  Vector6d twist = Vector6d::Zero();                              ///< m/s, rad/s; axes of base_link
  Matrix6d twist_covariance = Matrix6d::Zero();                   ///< axes of base_link
};

/// Converts the camera's motion to that of the base: T_odom_base = T_odom_start T_base_camera T_start_camera
/// T_camera_base.
///
/// First model of the uncertainty: each measured motion has the covariance that the odometry gives it, but at
/// least the lower bound of the parameters. A frame without a motion stands for an unknown velocity of
/// `lost_speed_m_s` and `lost_turn_rate_rad_s` (one sigma) since the previous frame. The covariance of the
/// pose is the sum over all motions, transformed by the adjoint (Sola et al., "A micro Lie theory", eq. 54).
/// The covariance of the twist is that of the last motion divided by its duration squared.
class BaseOdometry {
 public:
  /// Starts at the identity with the smallest covariance.
  BaseOdometry(const UncertaintyParams& params, const Eigen::Isometry3d& T_base_camera);

  /// Sets the parameters for all later motions.
  void setUncertainty(const UncertaintyParams& params) { params_ = params; }

  /// To be called when the odometry restarts: its next frame, the first one, is at `T_odom_base`.
  void start(const Eigen::Isometry3d& T_odom_base, const Matrix6d& pose_covariance);
  /// Moves the current pose of the base to `T_odom_base`; later motions continue from there.
  void setPose(const Eigen::Isometry3d& T_odom_base, const Matrix6d& pose_covariance);

  /// Adds the motion of a frame that was taken at `time_s`. Frames must come in order of time.
  const BaseEstimate& update(const odometry::FrameResult& result, double time_s);
  /// Returns pose and velocity after the newest frame.
  const BaseEstimate& estimate() const { return estimate_; }

 private:
  void addMotion(const odometry::FrameResult& result, double interval_s, bool measured_from_previous_frame);
  Matrix6d motionCovariance(const odometry::FrameResult& result, double interval_s) const;

  UncertaintyParams params_;
  Eigen::Isometry3d T_base_camera_;
  Matrix6d adjoint_base_camera_;
  Eigen::Isometry3d T_odom_start_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_start_base_ = Eigen::Isometry3d::Identity();  ///< newest pose of the base
  Matrix6d covariance_base_ = Matrix6d::Zero();  ///< covariance of the pose in the axes of the base
  std::optional<double> previous_time_s_;
  bool previous_lost_ = false;
  BaseEstimate estimate_;
};

}  // namespace stereo_nav::estimation
