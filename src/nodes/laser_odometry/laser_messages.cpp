#include "nodes/laser_odometry/laser_messages.h"

#include <tf2_eigen/tf2_eigen.h>

#include <cmath>

#include "core/planar_motion.h"
#include "ros/pose_messages.h"

namespace stereo_nav::nodes {
namespace {

using State = odometry::LaserOdometryResult::State;
static_assert(static_cast<int>(State::kTracking) == LaserStatus::TRACKING &&
                  static_cast<int>(State::kPartly) == LaserStatus::PARTLY &&
                  static_cast<int>(State::kCoasting) == LaserStatus::COASTING,
              "LaserStatus.state carries the value of LaserOdometryResult::State");

ros::Time stampOf(const LaserReading& reading) {
  return ros::Time().fromNSec(static_cast<std::uint64_t>(reading.stamp_ns));
}

}  // namespace

nav_msgs::Odometry toOdometry(const LaserReading& reading, const std::string& odom_frame,
                              const std::string& base_frame) {
  const odometry::LaserOdometryResult& result = reading.result;
  nav_msgs::Odometry odometry;
  odometry.header.stamp = stampOf(reading);
  odometry.header.frame_id = odom_frame;
  odometry.child_frame_id = base_frame;
  odometry.pose.pose = tf2::toMsg(inSpace(result.T_odom_base));
  ros_io::fillCovariance(spatialCovariance(result.pose_covariance), odometry.pose.covariance);
  odometry.twist.twist.linear.x = result.twist.x();
  odometry.twist.twist.linear.y = result.twist.y();
  odometry.twist.twist.angular.z = result.twist.z();
  ros_io::fillCovariance(spatialCovariance(result.twist_covariance), odometry.twist.covariance);
  return odometry;
}

LaserStatus toStatus(const LaserReading& reading, const ScanCounts& counts, const std::string& laser_frame) {
  const odometry::LaserOdometryResult& result = reading.result;
  LaserStatus status;
  status.header.stamp = stampOf(reading);
  status.header.frame_id = laser_frame;
  status.state = static_cast<std::uint8_t>(result.state);
  status.reason = result.reason;
  for (const Eigen::Vector3d& motion : result.untold) {
    geometry_msgs::Vector3 direction;
    direction.x = motion.x();
    direction.y = motion.y();
    direction.z = motion.z();
    status.untold.push_back(direction);
  }
  status.least_share = static_cast<float>(result.least_share);
  status.wheels = static_cast<std::uint8_t>(result.wheels);
  status.gyroscope = static_cast<std::uint8_t>(result.gyroscope);
  status.beams = static_cast<std::uint32_t>(reading.beams);
  status.points = static_cast<std::uint32_t>(result.points);
  status.matched_share = static_cast<float>(result.inlier_share);
  status.residual_scale = static_cast<float>(result.residual_scale);
  status.keyframe = static_cast<std::uint8_t>(result.keyframe);
  status.at_rest = static_cast<std::uint8_t>(result.at_rest);
  status.scans = counts.received;
  status.scans_dropped = counts.dropped;
  status.scans_partly = counts.partly;
  status.scans_coasting = counts.coasting;
  return status;
}

}  // namespace stereo_nav::nodes
