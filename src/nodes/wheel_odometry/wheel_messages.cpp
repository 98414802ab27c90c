#include "nodes/wheel_odometry/wheel_messages.h"

#include <tf2_eigen/tf2_eigen.h>

#include "core/planar_motion.h"
#include "ros/pose_messages.h"

namespace stereo_nav::nodes {
nav_msgs::Odometry toOdometry(const odometry::WheelOdometryResult& result, const std::string& odom_frame,
                              const std::string& base_frame) {
  nav_msgs::Odometry odometry;
  odometry.header.stamp = ros::Time(result.time_s);
  odometry.header.frame_id = odom_frame;
  odometry.child_frame_id = base_frame;
  odometry.pose.pose = tf2::toMsg(inSpace(result.T_odom_base));
  ros_io::fillCovariance(spatialCovariance(inAxesOf(result.T_odom_base, result.pose_covariance)),
                         odometry.pose.covariance);
  odometry.twist.twist.linear.x = result.twist.x();
  odometry.twist.twist.linear.y = result.twist.y();
  odometry.twist.twist.angular.z = result.twist.z();
  ros_io::fillCovariance(spatialCovariance(result.twist_covariance), odometry.twist.covariance);
  return odometry;
}

}  // namespace stereo_nav::nodes
