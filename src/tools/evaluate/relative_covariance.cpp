#include "tools/evaluate/relative_covariance.h"

#include <cmath>
#include <utility>

#include "core/base_pose.h"

namespace stereo_nav::tools {
namespace {

/// Begins without any uncertainty but the floor.
estimation::OdomCovariance started(const PoseParams& params, const Eigen::Isometry3d& T_base_camera) {
  estimation::OdomCovariance covariance(params.uncertainty, T_base_camera);
  covariance.start(Eigen::Matrix3d::Identity(), Matrix6d::Zero());
  return covariance;
}

}  // namespace

RelativeCovariance::RelativeCovariance(const PoseParams& params, const Eigen::Isometry3d& T_base_camera)
    : params_(params), T_base_camera_(T_base_camera), since_start_(started(params, T_base_camera)) {}

estimation::UncertainPose RelativeCovariance::add(odometry::FrameResult result, double time_s) {
  // Not `= {}`, which keeps the memory: some 12 kB a frame.
  result.features = decltype(result.features)();
  result.stage_times = decltype(result.stage_times)();
  frames_.push_back({std::move(result), time_s});
  if (frames_.size() > 1) addMotion(frames_.size() - 1, since_start_);
  estimation::UncertainPose pose;
  pose.T_odom_base = basePose(T_base_camera_, frames_.back().result.T_start_camera);
  pose.covariance = since_start_.pose(pose.T_odom_base.linear());
  return params_.floor.on ? onFloor(params_.floor, 0.0, pose) : pose;
}

Matrix6d RelativeCovariance::operator()(std::size_t from, std::size_t to) const {
  estimation::OdomCovariance covariance(params_.uncertainty, T_base_camera_);
  covariance.start(Eigen::Matrix3d::Identity(), Matrix6d::Zero(), frames_[from].result.pose_noise);
  for (std::size_t i = from + 1; i <= to; ++i) addMotion(i, covariance);
  const Matrix6d relative = covariance.pose(Eigen::Matrix3d::Identity());
  if (!params_.floor.on) return relative;
  estimation::FloorParams both_ends = params_.floor;
  both_ends.height_sigma_m *= std::sqrt(2.0);
  both_ends.tilt_sigma_rad *= std::sqrt(2.0);
  return onFloor(both_ends, 0.0, {Eigen::Isometry3d::Identity(), relative}).covariance;
}

void RelativeCovariance::addMotion(std::size_t frame, estimation::OdomCovariance& covariance) const {
  const odometry::FrameResult& result = frames_[frame].result;
  covariance.addMotion(result, basePose(T_base_camera_, result.T_previous_current),
                       frames_[frame].time_s - frames_[frame - 1].time_s);
}

}  // namespace stereo_nav::tools
