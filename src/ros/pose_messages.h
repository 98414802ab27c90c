#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include <Eigen/Geometry>
#include <boost/array.hpp>
#include <optional>
#include <string>

#include "stereo_nav/core/lie.h"

namespace stereo_nav::ros_io {

/// Nothing where a number is not finite, or the orientation is no quaternion of norm 1, within a hundredth.
std::optional<Eigen::Isometry3d> toPose(const geometry_msgs::Pose& message);

/// ROS covariances are row-major, which makes no difference since these are symmetric.
Matrix6d toCovariance(const boost::array<double, 36>& message);
void fillCovariance(const Matrix6d& covariance, boost::array<double, 36>& message);

/// A pose that somebody gives to a node, read and checked.
struct GivenPose {
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();  ///< odom: the frame that was asked for
  Matrix6d covariance = Matrix6d::Zero();
  std::string refusal;  ///< why it cannot be used; empty if it can
};

/// The pose must be in `frame`, or name no frame.
GivenPose readPose(const geometry_msgs::PoseWithCovarianceStamped& message, const std::string& frame);

}  // namespace stereo_nav::ros_io
