#pragma once

#include <optional>

#include "vision/stereo_view.h"

namespace stereo_nav::odometry {

/// What is known of a frame's motion before its features are searched for. Twists are those of the world in
/// the left camera's frame, m/s and rad/s.
struct MotionPrior {
  Eigen::Isometry3d T_previous_world = Eigen::Isometry3d::Identity();
  /// Rotation since the previous frame, measured by the IMU, and its sigma per axis.
  std::optional<Eigen::Matrix3d> R_current_previous;
  double rotation_sigma_rad = 1.0;

  double right_time_offset_s = 0.0;  ///< right stamp minus left stamp; 0 leaves T_late_camera at identity
  double interval_s = 0.0;           ///< time since the previous frame
  std::optional<Vector6d> previous_twist;   ///< at the previous frame, if it is known
  Vector6d twist_sigma = Vector6d::Ones();  ///< of the twist predicted from previous_twist and this motion
  std::optional<Eigen::Matrix3d> R_late_camera;  ///< rotation between the two stamps, measured by the IMU

  /// Whether a velocity or the IMU predicts the motion since the previous frame.
  bool predictsMotion() const { return previous_twist || R_current_previous; }
  /// The view with constant velocity, turned as the IMU says where it says anything.
  vision::StereoView predictedView() const;
  /// The twist in the current frame if `view` is its pose.
  Vector6d twistAt(const vision::StereoView& view) const;
  /// How well T_late_camera is known before the right image is looked at: m, rad.
  Vector6d lateSigma() const;
};

/// The twist at the end of a motion under constant acceleration: the mean twist since the previous frame,
/// extrapolated from the twist there (conditional mean of a Gauss-Markov velocity; Barfoot, Tong and Sarkka
/// 2014). Without a previous twist it is the mean.
Vector6d extrapolatedTwist(const Eigen::Isometry3d& T_current_previous, double interval_s,
                           const std::optional<Vector6d>& previous_twist);

}  // namespace stereo_nav::odometry
