#include "estimation/ekf/fusion_params.h"

#include <limits>

namespace stereo_nav::estimation {

void FusionParams::describe(ParameterVisitor& visitor) {
  visitor.real("frequency", frequency_hz, {0.1, 1000.0}, "Hz", "how often odometry/filtered is published");
  visitor.flag("two_d_mode", two_d_mode, "estimate x, y and yaw alone: the robot drives on a plane");
  visitor.text("map_frame", map_frame, "frame of absolute positions");
  visitor.text("odom_frame", odom_frame, "frame in which the pose never jumps");
  visitor.text("base_link_frame", base_link_frame, "frame of the robot whose pose is estimated");
  visitor.text(
      "world_frame", world_frame,
      "map_frame or odom_frame: the frame that poses are published in; with map_frame, tf is map_frame -> odom_frame");
  visitor.flag("publish_tf", publish_tf, "publish the pose as tf");
  visitor.flag("publish_acceleration", publish_acceleration, "publish accel/filtered, too");
  visitor.flag("predict_to_current_time", predict_to_current_time,
               "publish the pose of now instead of that of the newest measurement");
  visitor.real("transform_time_offset", transform_time_offset_s, {-10.0, 10.0}, "s",
               "added to the stamps in tf");
  visitor.real("sensor_timeout", sensor_timeout_s, {0.001, 60.0}, "s",
               "silence of a sensor before diagnostics name it");
  visitor.flag("disabled_at_startup", disabled_at_startup,
               "take in nothing until the service enable is called");
  filter.describe(visitor);
}

void FusedSensorParams::describe(ParameterVisitor& visitor) {
  visitor.flag("differential", differential, "of its poses only the motions from message to message count");
  visitor.flag("relative", relative, "its poses count from the first one");
  visitor.flag(
      "absolute", absolute,
      "odomN only: its poses are poses in world_frame, as those of a GNSS are; else only their motions count");
  visitor.flag(
      "wheel_scales", wheel_scales,
      "it measures by wheels, whose scales (forward, left, turning) are estimated; one sensor at most");
  visitor.integer("queue_size", queue_size, {1, 100000}, "", "messages that wait for the node");
  visitor.flag("nodelay", nodelay, "without Nagle's algorithm");
  visitor.real("pose_rejection_threshold", pose_rejection_threshold,
               {0.0, std::numeric_limits<double>::max()}, "",
               "Mahalanobis distance beyond which a pose is refused; 0: by gate_share");
  visitor.real("twist_rejection_threshold", twist_rejection_threshold,
               {0.0, std::numeric_limits<double>::max()}, "", "the same of velocities and turn rates");
  visitor.real("linear_acceleration_rejection_threshold", linear_acceleration_rejection_threshold,
               {0.0, std::numeric_limits<double>::max()}, "", "the same of accelerations");
  visitor.flag(
      "remove_gravitational_acceleration", remove_gravitational_acceleration,
      "imuN only: its accelerations hold gravity, as an accelerometer's do; off: its driver has taken it off");
  visitor.real("reading_sigma_m", reading_sigma_m, {1e-6, 100.0}, "m",
               "noise of a single pose of an odometry, which does not add up over its motions");
  visitor.real("reading_sigma_rad", reading_sigma_rad, {1e-6, 3.2}, "rad", "the same of its attitude");
}

}  // namespace stereo_nav::estimation
