#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "stereo_nav/core/lie.h"
#include "stereo_nav/core/parameter_visitor.h"
#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::estimation {

/// What the uncertainty of a motion is at least, and what it is while none is measured.
struct UncertaintyParams {
  double min_translation_sigma_m = 0.001;  ///< per frame and axis
  double min_rotation_sigma_rad = 0.0005;  ///< per frame and axis
  double lost_speed_m_s = 1.0;             ///< while no motion is measured
  double lost_turn_rate_rad_s = 1.0;       ///< while no motion is measured

  /// Names, ranges and meanings of the parameters.
  void describe(ParameterVisitor& visitor);
};

/// Pose and velocity of the base as nav_msgs/Odometry wants them; covariances in the order x y z, then
/// rotation about x y z.
struct BaseEstimate {
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();  ///< pose of base_link in odom
  Matrix6d pose_covariance = Matrix6d::Zero();                    ///< axes of odom
  Vector6d twist = Vector6d::Zero();                              ///< m/s, rad/s; axes of base_link
  Matrix6d twist_covariance = Matrix6d::Zero();                   ///< axes of base_link
};

/// Carries the camera's motion over to the base: T_odom_base = T_odom_start T_base_camera T_start_camera
/// T_camera_base.
///
/// First model of the uncertainty: each measured motion has the covariance that the odometry gives it, at
/// least the floor of the parameters; a frame without a motion means an unknown velocity of `lost_speed`,
/// `lost_turn_rate` (one sigma) since the frame before. The pose's covariance is the sum over all motions,
/// carried along by the adjoint (Sola et al., "A micro Lie theory", eq. 54); the twist's is that of the last
/// motion by its duration squared.
class BaseOdometry {
 public:
  /// Starts at the identity with the least covariance.
  BaseOdometry(const UncertaintyParams& params, const Eigen::Isometry3d& T_base_camera);

  /// For the motions to come.
  void setUncertainty(const UncertaintyParams& params) { params_ = params; }

  /// The odometry begins anew: its next first frame is taken at `T_odom_base`.
  void start(const Eigen::Isometry3d& T_odom_base, const Matrix6d& pose_covariance);
  /// From now on the base is said to be at `T_odom_base`; motion goes on.
  void setPose(const Eigen::Isometry3d& T_odom_base, const Matrix6d& pose_covariance);

  /// Adds the motion of a frame that was taken at `time_s`, in order of time.
  const BaseEstimate& update(const odometry::FrameResult& result, double time_s);
  /// After the newest frame.
  const BaseEstimate& estimate() const { return estimate_; }

 private:
  void addMotion(const odometry::FrameResult& result, double interval_s, bool measured_from_previous_frame);
  Matrix6d motionCovariance(const odometry::FrameResult& result, double interval_s) const;

  UncertaintyParams params_;
  Eigen::Isometry3d T_base_camera_;
  Matrix6d adjoint_base_camera_;
  Eigen::Isometry3d T_odom_start_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_start_base_ = Eigen::Isometry3d::Identity();  ///< newest, by the odometry
  Matrix6d covariance_base_ = Matrix6d::Zero();                     ///< of the pose, axes of the base
  std::optional<double> previous_time_s_;
  bool previous_lost_ = false;
  BaseEstimate estimate_;
};

}  // namespace stereo_nav::estimation
