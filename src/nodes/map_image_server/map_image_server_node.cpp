#include "nodes/map_image_server/map_image_server_node.h"

#include <utility>

#include "grid/map_file.h"
#include "nodes/map_image_server/map_image_server_params.h"
#include "ros/grid_messages.h"
#include "ros/parameter_server.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::nodes {

MapImageServerNode::MapImageServerNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle)
    : handle_(std::move(handle)) {
  MapImageServerParams params;
  ros_io::readParameters({ros_io::serverSource(private_handle)}, params);
  if (params.map.empty())
    throw InputError("map is not set: which map? e.g. `roslaunch stereo_nav map.launch map:=$PWD/hall.yaml`");
  const grid::OccupancyGrid grid = grid::loadMap(params.map);
  ros_io::fillMessage(grid, params.frame_id, ros::Time::now(), map_.map);
  static_map_ = handle_.advertiseService<nav_msgs::GetMap::Request, nav_msgs::GetMap::Response>(
      "static_map", [this](nav_msgs::GetMap::Request& /*request*/, nav_msgs::GetMap::Response& response) {
        response = map_;
        return true;
      });
  metadata_publisher_ = handle_.advertise<nav_msgs::MapMetaData>("map_metadata", 1, true);
  metadata_publisher_.publish(map_.map.info);
  map_publisher_ = handle_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
  map_publisher_.publish(map_.map);
  ROS_INFO_STREAM("map " << params.map << ": " << grid.geometry.width << " x " << grid.geometry.height
                         << " cells of " << grid.geometry.resolution_m << " m");
}

}  // namespace stereo_nav::nodes
