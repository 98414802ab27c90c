#include "odometry/stereo/motion_prior.h"

#include <cmath>

namespace stereo_nav::odometry {

vision::StereoView MotionPrior::predictedView() const {
  const Vector6d twist = previous_twist.value_or(Vector6d::Zero());
  Eigen::Isometry3d T_current_previous = expMotion(twist * interval_s);
  vision::StereoView view;
  view.T_late_camera = expMotion(twist * right_time_offset_s);
  if (R_current_previous) T_current_previous.linear() = *R_current_previous;
  if (R_late_camera) view.T_late_camera.linear() = *R_late_camera;
  view.T_camera_world = T_current_previous * T_previous_world;
  return view;
}

Vector6d MotionPrior::twistAt(const vision::StereoView& view) const {
  return extrapolatedTwist(view.T_camera_world * T_previous_world.inverse(), interval_s, previous_twist);
}

Vector6d MotionPrior::lateSigma() const {
  Vector6d sigma = twist_sigma * std::abs(right_time_offset_s);
  if (R_late_camera) sigma.tail<3>().setConstant(rotation_sigma_rad);
  return sigma;
}

Vector6d extrapolatedTwist(const Eigen::Isometry3d& T_current_previous, double interval_s,
                           const std::optional<Vector6d>& previous_twist) {
  Vector6d mean = logMotion(T_current_previous) / interval_s;
  if (!previous_twist) return mean;
  return 1.5 * mean - 0.5 * *previous_twist;
}

}  // namespace stereo_nav::odometry
