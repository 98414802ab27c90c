#include "nodes/navigator/navigator_messages.h"

#include <tf2/utils.h>

#include <cmath>
#include <limits>

#include "core/planar_motion.h"

namespace stereo_nav::nodes {
namespace {

constexpr double kUnitTolerance = 0.01;

}  // namespace

std::optional<FloorPose> toFloorPose(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!std::isfinite(pose.position.x) || !std::isfinite(pose.position.y) || !std::isfinite(norm))
    return std::nullopt;
  if (norm > 0.0 && std::abs(norm - 1.0) > kUnitTolerance) return std::nullopt;
  FloorPose result{{pose.position.x, pose.position.y}, std::nullopt};
  if (norm > 0.0) result.heading_rad = tf2::getYaw(q);
  return result;
}

geometry_msgs::Pose toMessage(const navigation::PlanarPose& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.position_m.x();
  message.position.y = pose.position_m.y();
  message.orientation.z = std::sin(0.5 * pose.heading_rad);
  message.orientation.w = std::cos(0.5 * pose.heading_rad);
  return message;
}

nav_msgs::Path toPath(const std::vector<Eigen::Vector2d>& points, const std::string& frame,
                      const ros::Time& stamp) {
  nav_msgs::Path path;
  path.header.frame_id = frame;
  path.header.stamp = stamp;
  double heading_rad = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i + 1 < points.size()) {
      const Eigen::Vector2d way = points[i + 1] - points[i];
      heading_rad = std::atan2(way.y(), way.x());
    }
    geometry_msgs::PoseStamped pose;
    pose.header = path.header;
    pose.pose = toMessage({points[i], heading_rad});
    path.poses.push_back(pose);
  }
  return path;
}

Eigen::Isometry2d onFloor(const geometry_msgs::Pose& pose) {
  Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
  T.linear() = Eigen::Rotation2Dd(tf2::getYaw(pose.orientation)).toRotationMatrix();
  T.translation() = Eigen::Vector2d(pose.position.x, pose.position.y);
  return T;
}

double positionSigma(const nav_msgs::Odometry& odometry) {
  Eigen::Matrix2d covariance;
  covariance << odometry.pose.covariance[0], odometry.pose.covariance[1], odometry.pose.covariance[6],
      odometry.pose.covariance[7];
  if (!covariance.allFinite()) return std::numeric_limits<double>::infinity();
  return largestSigma(covariance);
}

}  // namespace stereo_nav::nodes
