#include "nodes/ekf_localization/filtered_messages.h"

#include <tf2_eigen/tf2_eigen.h>

#include "ros/pose_messages.h"

namespace stereo_nav::nodes {
nav_msgs::Odometry toOdometry(const estimation::FusedEstimate& estimate,
                              const estimation::FusionParams& params) {
  nav_msgs::Odometry odometry;
  odometry.header.stamp = ros::Time(estimate.time_s);
  odometry.header.frame_id = params.world_frame;
  odometry.child_frame_id = params.base_link_frame;
  odometry.pose.pose = tf2::toMsg(estimate.T_world_base);
  ros_io::fillCovariance(estimate.pose_covariance, odometry.pose.covariance);
  odometry.twist.twist = tf2::toMsg(estimate.twist);
  ros_io::fillCovariance(estimate.twist_covariance, odometry.twist.covariance);
  return odometry;
}

geometry_msgs::AccelWithCovarianceStamped toAcceleration(const estimation::FusedEstimate& estimate,
                                                         const estimation::FusionParams& params) {
  geometry_msgs::AccelWithCovarianceStamped acceleration;
  acceleration.header.stamp = ros::Time(estimate.time_s);
  acceleration.header.frame_id = params.base_link_frame;
  tf2::toMsg(estimate.acceleration, acceleration.accel.accel.linear);
  return acceleration;
}

geometry_msgs::TransformStamped toTransform(const Eigen::Isometry3d& T_parent_child,
                                            const std::string& parent, const std::string& child,
                                            double time_s) {
  geometry_msgs::TransformStamped transform = tf2::eigenToTransform(T_parent_child);
  transform.header.stamp = ros::Time(time_s);
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  return transform;
}

}  // namespace stereo_nav::nodes
