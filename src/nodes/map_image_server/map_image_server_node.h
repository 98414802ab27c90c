#pragma once

#include <nav_msgs/GetMap.h>
#include <ros/ros.h>

namespace stereo_nav::nodes {

/// What map_server offers: the topics `map` and `map_metadata`, both latched, and the service `static_map`,
/// from a file of its format.
class MapImageServerNode {
 public:
  /// Throws ParameterError, and InputError that says what is wrong with the map.
  MapImageServerNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle);

 private:
  ros::NodeHandle handle_;
  nav_msgs::GetMap::Response map_;
  ros::Publisher map_publisher_, metadata_publisher_;
  ros::ServiceServer static_map_;
};

}  // namespace stereo_nav::nodes
