#pragma once

#include <geometry_msgs/Pose.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>

#include <optional>
#include <string>
#include <vector>

#include "navigation/control/drive_model.h"
#include "navigation/planner/plan.h"
#include "ros/grid_messages.h"

namespace stereo_nav::nodes {

using ros_io::toGrid;

/// A pose on the floor. An orientation of zeros has no heading. Nothing where a number is not finite, or the
/// orientation is no unit quaternion.
struct FloorPose {
  Eigen::Vector2d position_m;
  std::optional<double> heading_rad;
};
std::optional<FloorPose> toFloorPose(const geometry_msgs::Pose& pose);
geometry_msgs::Pose toMessage(const navigation::PlanarPose& pose);

/// A way of points, each with the heading of the way to the next.
nav_msgs::Path toPath(const std::vector<Eigen::Vector2d>& points, const std::string& frame,
                      const ros::Time& stamp);

Eigen::Isometry2d onFloor(const geometry_msgs::Pose& pose);
/// Of the position, the largest in any direction; infinite where the covariance has no finite numbers.
double positionSigma(const nav_msgs::Odometry& odometry);

}  // namespace stereo_nav::nodes
