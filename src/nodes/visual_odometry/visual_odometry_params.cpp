#include "nodes/visual_odometry/visual_odometry_params.h"

namespace stereo_nav::nodes {

void VisualOdometryParams::describe(ParameterVisitor& visitor) {
  visitor.text("odom_frame", odom_frame, "frame that poses are published in");
  visitor.text("base_frame", base_frame, "frame of the robot whose pose is published");
  visitor.text("imu_frame", imu_frame,
               "frame of the IMU; empty: that of its messages, and base_frame for imu_quat, which has none");
  visitor.flag("publish_tf", publish_tf, "publish odom_frame -> base_frame in tf; off where a filter does",
               Change::kLive);
  visitEnum(visitor, "imu", imu, {{"none", Imu::kNone}, {"imu", Imu::kImu}, {"quaternion", Imu::kQuaternion}},
            "which topic: none, imu/data (sensor_msgs/Imu), or imu_quat (geometry_msgs/Quaternion, stamped "
            "on arrival)");
  visitEnum(visitor, "initial_attitude", initial_attitude,
            {{"identity", InitialAttitude::kIdentity}, {"gravity", InitialAttitude::kGravity}},
            "the odometry frame is base_frame at the start, or that with its z axis levelled by the IMU");
  visitor.real("input_timeout_s", input_timeout_s, {0.5, 60.0}, "s",
               "silence of a topic, or time without a complete frame, before the node explains it",
               Change::kLive);
  visitor.integer("path_max_poses", path_max_poses, {2, 1000000}, "",
                  "poses kept for `path`; when there are more, every second one is removed");
  visitor.real("path_spacing_m", path_spacing_m, {0.0, 100.0}, "m", "distance between poses of `path`",
               Change::kLive);
  visitSection(visitor, "synchronisation", synchronisation);
  visitSection(visitor, "waiting", waiting);
  visitSection(visitor, "uncertainty", uncertainty);
  floor.describe(visitor);
}

}  // namespace stereo_nav::nodes
