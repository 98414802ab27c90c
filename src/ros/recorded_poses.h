#pragma once

#include <rosbag/bag.h>

#include <string>

#include "stereo_nav/core/trajectory.h"
#include "stereo_nav/ros/recorded_order.h"

namespace stereo_nav::ros_io {

/// Poses of a topic in the order of recording, and the frame that they describe, which is empty when the type
/// does not name it.
struct RecordedPoses {
  Trajectory trajectory;
  std::string body_frame;
  std::string world_frame;  ///< frame that the poses are given in; empty where the messages do not name it
};

/// Reads nav_msgs/Odometry, geometry_msgs/PoseStamped or TransformStamped. Throws InputError, which begins
/// with `path`, for other types.
RecordedPoses readRecordedPoses(const rosbag::Bag& bag, const RecordedOrder& order, const std::string& path,
                                const std::string& topic);

}  // namespace stereo_nav::ros_io
