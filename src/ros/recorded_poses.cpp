#include "ros/recorded_poses.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>

#include "ros/setup_checks.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::ros_io {
namespace {

StampedPose toStampedPose(const ros::Time& stamp, const geometry_msgs::Pose& pose) {
  geometry_msgs::Transform transform;
  transform.translation.x = pose.position.x;
  transform.translation.y = pose.position.y;
  transform.translation.z = pose.position.z;
  transform.rotation = pose.orientation;
  return {stamp.toSec(), toIsometry(transform)};
}

}  // namespace

RecordedPoses readRecordedPoses(const rosbag::Bag& bag, const RecordedOrder& order, const std::string& path,
                                const std::string& topic) {
  RecordedPoses poses;
  order.forEach(bag, {topic}, [&](const rosbag::MessageInstance& message, const ros::Time&) {
    if (const auto odometry = message.instantiate<nav_msgs::Odometry>()) {
      poses.trajectory.push_back(toStampedPose(odometry->header.stamp, odometry->pose.pose));
      poses.body_frame = withoutSlash(odometry->child_frame_id);
      poses.world_frame = withoutSlash(odometry->header.frame_id);
    } else if (const auto pose = message.instantiate<geometry_msgs::PoseStamped>()) {
      poses.trajectory.push_back(toStampedPose(pose->header.stamp, pose->pose));
      poses.world_frame = withoutSlash(pose->header.frame_id);
    } else if (const auto transform = message.instantiate<geometry_msgs::TransformStamped>()) {
      poses.trajectory.push_back({transform->header.stamp.toSec(), toIsometry(transform->transform)});
      poses.body_frame = withoutSlash(transform->child_frame_id);
      poses.world_frame = withoutSlash(transform->header.frame_id);
    } else {
      throw InputError(
          path + ": ground truth topic " + topic + " is " + message.getDataType() +
          ", expected nav_msgs/Odometry, geometry_msgs/PoseStamped or geometry_msgs/TransformStamped");
    }
  });
  return poses;
}

}  // namespace stereo_nav::ros_io
