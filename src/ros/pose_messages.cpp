#include "ros/pose_messages.h"

#include <cmath>

#include "ros/setup_checks.h"

namespace stereo_nav::ros_io {

std::optional<Eigen::Isometry3d> toPose(const geometry_msgs::Pose& message) {
  constexpr double kUnitNorm = 0.01;
  const auto& orientation = message.orientation;
  const Eigen::Quaterniond q(orientation.w, orientation.x, orientation.y, orientation.z);
  const Eigen::Vector3d position(message.position.x, message.position.y, message.position.z);
  if (!position.allFinite() || !(std::abs(q.norm() - 1.0) < kUnitNorm)) return std::nullopt;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = q.normalized().toRotationMatrix();
  T.translation() = position;
  return T;
}

Matrix6d toCovariance(const boost::array<double, 36>& message) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.data());
}

void fillCovariance(const Matrix6d& covariance, boost::array<double, 36>& message) {
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.data()) = covariance;
}

GivenPose readPose(const geometry_msgs::PoseWithCovarianceStamped& message, const std::string& frame) {
  const std::string given = withoutSlash(message.header.frame_id);
  const auto T = toPose(message.pose.pose);
  GivenPose read;
  read.covariance = toCovariance(message.pose.covariance);
  if (!given.empty() && given != frame) {
    read.refusal = "the pose is in frame '" + given + "', it must be in '" + frame + "'";
  } else if (!T || !read.covariance.allFinite()) {
    read.refusal = "position and covariance must be numbers, the orientation a quaternion of norm 1";
  } else {
    read.T_odom_base = *T;
  }
  return read;
}

}  // namespace stereo_nav::ros_io
