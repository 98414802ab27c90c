#include "ros/odom_transform_publisher.h"

#include <geometry_msgs/TransformStamped.h>

namespace stereo_nav::ros_io {

void OdomTransformPublisher::publish(const nav_msgs::Odometry& odometry) {
  geometry_msgs::TransformStamped transform;
  transform.header = odometry.header;
  transform.child_frame_id = odometry.child_frame_id;
  transform.transform.translation.x = odometry.pose.pose.position.x;
  transform.transform.translation.y = odometry.pose.pose.position.y;
  transform.transform.translation.z = odometry.pose.pose.position.z;
  transform.transform.rotation = odometry.pose.pose.orientation;
  broadcaster_.sendTransform(transform);
}

}  // namespace stereo_nav::ros_io
