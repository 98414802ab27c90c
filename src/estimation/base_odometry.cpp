#include "stereo_nav/estimation/base_odometry.h"

#include "core/base_pose.h"

namespace stereo_nav::estimation {

BaseOdometry::BaseOdometry(const UncertaintyParams& params, const Eigen::Isometry3d& T_base_camera)
    : covariance_(params, T_base_camera), T_base_camera_(T_base_camera) {
  start(Eigen::Isometry3d::Identity(), Matrix6d::Zero());
}

void BaseOdometry::start(const Eigen::Isometry3d& T_odom_base, const Matrix6d& pose_covariance) {
  T_start_base_.setIdentity();
  previous_time_s_.reset();
  previous_measured_ = true;
  setPose(T_odom_base, pose_covariance);
  estimate_.twist.setZero();
  estimate_.twist_covariance = covariance_.unknownTwist();
}

void BaseOdometry::setPose(const Eigen::Isometry3d& T_odom_base, const Matrix6d& pose_covariance) {
  T_odom_start_ = T_odom_base * T_start_base_.inverse();
  floor_height_m_ = T_odom_base.translation().z();
  estimate_.T_odom_base = T_odom_base;
  estimate_.pose_covariance = covariance_.start(T_odom_base.linear(), pose_covariance);
}

const BaseEstimate& BaseOdometry::update(const odometry::FrameResult& result, double time_s) {
  T_start_base_ = basePose(T_base_camera_, result.T_start_camera);
  if (previous_time_s_) setTwist(result, time_s - *previous_time_s_);
  UncertainPose pose;
  pose.T_odom_base = T_odom_start_ * T_start_base_;
  pose.covariance = covariance_.pose(pose.T_odom_base.linear());
  if (floor_.on) pose = onFloor(floor_, floor_height_m_, pose);
  estimate_.T_odom_base = pose.T_odom_base;
  estimate_.pose_covariance = pose.covariance;
  previous_time_s_ = time_s;
  previous_measured_ = odometry::isMeasured(result.state) || result.new_map;
  return estimate_;
}

void BaseOdometry::setTwist(const odometry::FrameResult& result, double interval_s) {
  const Eigen::Isometry3d T_previous_base = basePose(T_base_camera_, result.T_previous_current);
  const Matrix6d covariance = covariance_.addMotion(result, T_previous_base, interval_s);
  // After frames without a measurement the motion may span more than the last interval: its speed is unknown.
  const bool is_known = result.state == odometry::State::kCoasting ||
                        (result.state == odometry::State::kTracking && previous_measured_);
  estimate_.twist = is_known ? Vector6d(logMotion(T_previous_base) / interval_s) : Vector6d::Zero();
  estimate_.twist_covariance =
      is_known ? Matrix6d(covariance / (interval_s * interval_s)) : covariance_.unknownTwist();
}

}  // namespace stereo_nav::estimation
