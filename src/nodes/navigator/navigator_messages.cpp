#include "nodes/navigator/navigator_messages.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::nodes {
namespace {

constexpr double kUnitTolerance = 0.01;

double yawOf(const geometry_msgs::Quaternion& q) {
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

}  // namespace

grid::OccupancyGrid toGrid(const nav_msgs::OccupancyGrid& message) {
  grid::OccupancyGrid grid;
  grid.geometry.width = static_cast<int>(message.info.width);
  grid.geometry.height = static_cast<int>(message.info.height);
  grid.geometry.resolution_m = double{message.info.resolution};
  grid.geometry.origin_x_m = message.info.origin.position.x;
  grid.geometry.origin_y_m = message.info.origin.position.y;
  grid.geometry.origin_yaw_rad = yawOf(message.info.origin.orientation);
  if (message.data.size() != grid.geometry.size() || message.data.empty() ||
      !(message.info.resolution > 0.0F))
    throw InputError(fmt::format("a grid of {} x {} cells of {} m holds {} values; its sender is wrong",
                                 message.info.width, message.info.height, message.info.resolution,
                                 message.data.size()));
  grid.cells.assign(message.data.begin(), message.data.end());
  return grid;
}

std::optional<FloorPose> toFloorPose(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!std::isfinite(pose.position.x) || !std::isfinite(pose.position.y) || !std::isfinite(norm))
    return std::nullopt;
  if (norm > 0.0 && std::abs(norm - 1.0) > kUnitTolerance) return std::nullopt;
  FloorPose result{{pose.position.x, pose.position.y}, std::nullopt};
  if (norm > 0.0) result.heading_rad = yawOf(q);
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
  T.linear() = Eigen::Rotation2Dd(yawOf(pose.orientation)).toRotationMatrix();
  T.translation() = Eigen::Vector2d(pose.position.x, pose.position.y);
  return T;
}

double positionSigma(const nav_msgs::Odometry& odometry) {
  Eigen::Matrix2d covariance;
  covariance << odometry.pose.covariance[0], odometry.pose.covariance[1], odometry.pose.covariance[6],
      odometry.pose.covariance[7];
  if (!covariance.allFinite()) return std::numeric_limits<double>::infinity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().y()));
}

}  // namespace stereo_nav::nodes
