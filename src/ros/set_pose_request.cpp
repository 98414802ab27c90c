#include "ros/set_pose_request.h"

#include <cmath>

namespace stereo_nav::ros_io {

SetPoseRequest readSetPose(const SetPose::Request& request, const std::string& odom_frame) {
  constexpr double kUnitNorm = 0.01;
  const auto& pose = request.pose.pose.pose;
  const Eigen::Quaterniond q(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  const Eigen::Vector3d position(pose.position.x, pose.position.y, pose.position.z);
  const std::string& frame = request.pose.header.frame_id;
  SetPoseRequest read;
  read.covariance =
      Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(request.pose.pose.covariance.data());
  if (!frame.empty() && frame != odom_frame) {
    read.refusal = "the pose is in frame '" + frame + "', it must be in '" + odom_frame + "'";
  } else if (!position.allFinite() || !read.covariance.allFinite() ||
             !(std::abs(q.norm() - 1.0) < kUnitNorm)) {
    read.refusal = "position and covariance must be numbers, the orientation a quaternion of norm 1";
  } else {
    read.T_odom_base.linear() = q.normalized().toRotationMatrix();
    read.T_odom_base.translation() = position;
  }
  return read;
}

}  // namespace stereo_nav::ros_io
