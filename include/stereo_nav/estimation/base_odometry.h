#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "stereo_nav/core/lie.h"
#include "stereo_nav/estimation/floor_constraint.h"
#include "stereo_nav/estimation/odom_covariance.h"
#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::estimation {

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
class BaseOdometry {
 public:
  /// Starts at the identity with the smallest covariance.
  BaseOdometry(const UncertaintyParams& params, const Eigen::Isometry3d& T_base_camera);

  /// Sets the parameters for all later motions.
  void setUncertainty(const UncertaintyParams& params) { covariance_.setUncertainty(params); }
  /// Whether the base stays on the floor on which it started, or was set. From the next frame on.
  void setFloor(const FloorParams& params) { floor_ = params; }

  /// The odometry begins anew: its next first frame is taken at `T_odom_base`.
  void start(const Eigen::Isometry3d& T_odom_base, const Matrix6d& pose_covariance);
  /// Sets the current pose of the base. Later motions are added to it.
  void setPose(const Eigen::Isometry3d& T_odom_base, const Matrix6d& pose_covariance);

  /// Adds the motion of a frame that was taken at `time_s`, in order of time.
  const BaseEstimate& update(const odometry::FrameResult& result, double time_s);
  /// After the newest frame.
  const BaseEstimate& estimate() const { return estimate_; }

 private:
  void setTwist(const odometry::FrameResult& result, double interval_s);

  OdomCovariance covariance_;
  FloorParams floor_;
  double floor_height_m_ = 0.0;  ///< in odom
  Eigen::Isometry3d T_base_camera_;
  Eigen::Isometry3d T_odom_start_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_start_base_ = Eigen::Isometry3d::Identity();  ///< newest, by the odometry
  std::optional<double> previous_time_s_;
  bool previous_measured_ = true;
  BaseEstimate estimate_;
};

}  // namespace stereo_nav::estimation
