#include "ros/grid_messages.h"

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include "core/planar_motion.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::ros_io {

void fillMessage(const grid::OccupancyGrid& grid, const std::string& frame, const ros::Time& stamp,
                 nav_msgs::OccupancyGrid& message) {
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  message.info.map_load_time = stamp;
  message.info.resolution = static_cast<float>(grid.geometry.resolution_m);
  message.info.width = static_cast<std::uint32_t>(grid.geometry.width);
  message.info.height = static_cast<std::uint32_t>(grid.geometry.height);
  message.info.origin = tf2::toMsg(inSpace(grid.geometry.T_map_grid()));
  message.data.assign(grid.cells.begin(), grid.cells.end());
}

grid::OccupancyGrid toGrid(const nav_msgs::OccupancyGrid& message) {
  const auto& info = message.info;
  if (message.data.empty() || message.data.size() != std::size_t{info.width} * info.height) {
    throw InputError(fmt::format("the map has {} cells, but says that it is {} x {}; what publishes it?",
                                 message.data.size(), info.width, info.height));
  }
  Eigen::Isometry3d T_map_grid;
  tf2::fromMsg(info.origin, T_map_grid);
  Eigen::Quaterniond turn;
  tf2::fromMsg(info.origin.orientation, turn);
  const bool upright = T_map_grid.matrix().allFinite() && T_map_grid.linear()(2, 2) > 0.999 &&
                       std::abs(turn.norm() - 1.0) < 1e-3;
  if (!(info.resolution > 0.0F) || !upright) {
    throw InputError(fmt::format(
        "the map's resolution is {} m and the third axis of its origin has z = {:.3f}; it must be "
        "above zero, and the origin in the plane with a quaternion of length 1",
        info.resolution, T_map_grid.linear()(2, 2)));
  }
  const Eigen::Isometry2d T = planarPart(T_map_grid);
  grid::GridGeometry geometry;
  geometry.width = static_cast<int>(info.width);
  geometry.height = static_cast<int>(info.height);
  geometry.resolution_m = double{info.resolution};
  geometry.origin_x_m = T.translation().x();
  geometry.origin_y_m = T.translation().y();
  geometry.origin_yaw_rad = yawOf(T);
  grid::OccupancyGrid grid(geometry);
  grid.cells.assign(message.data.begin(), message.data.end());
  return grid;
}

}  // namespace stereo_nav::ros_io
