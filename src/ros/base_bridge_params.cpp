#include "ros/base_bridge_params.h"

#include "core/parameter_list.h"
#include "ros/topic_names.h"

namespace stereo_nav::ros_io {

void BaseJointParams::describe(ParameterVisitor& visitor) {
  visitor.text("name", name, "name in joint_states and of the topic joints/NAME");
  visitor.real("min_deg", min_deg, {-3600.0, 3600.0}, "deg", "smallest angle that is sent");
  visitor.real("max_deg", max_deg, {-3600.0, 3600.0}, "deg", "largest angle that is sent");
  visitEnum(
      visitor, "axis", axis,
      {{"roll", JointAxis::kRoll}, {"pitch", JointAxis::kPitch}, {"yaw", JointAxis::kYaw}},
      "axis of its own frame that it turns about; pitch: positive looks down, yaw: positive turns left");
  visitor.flag("carries_camera", carries_camera,
               "the cameras turn with it; mounting/camera is their place at an angle of zero");
  visitSection(visitor, "mounting", mounting);
}

void BaseRangeParams::describe(ParameterVisitor& visitor) {
  visitor.text("name", name, "the topic is range/NAME");
  visitor.text("frame_id", frame_id, "frame, which looks along its x axis; empty: range_NAME");
  visitor.flag("ultrasound", ultrasound, "false: it measures with light");
  visitor.real("field_of_view_deg", field_of_view_deg, {0.01, 180.0}, "deg", "full opening angle");
  visitor.real("min_range_m", min_range_m, {0.0, 100.0}, "m", "what is nearer becomes -infinity (REP-117)");
  visitor.real("max_range_m", max_range_m, {0.0, 100.0}, "m", "what is farther becomes +infinity (REP-117)");
  visitSection(visitor, "mounting", mounting);
}

void BaseNameParams::describe(ParameterVisitor& visitor) {
  visitor.text("name", name, "part of the topics");
}

void BaseBridgeParams::checkNames() const {
  checkTopicNames(joints, "base: the joint");
  checkTopicNames(ranges, "base: the range finder");
  checkTopicNames(switches, "base: the switch");
  checkTopicNames(actuators, "base: the actuator");
}

void BaseBridgeParams::describe(ParameterVisitor& visitor) {
  visitor.text("port", port, "serial port, better by its lasting name /dev/serial/by-id/...");
  visitor.text("by_id_directory", by_id_directory, "folder of lasting names of serial ports");
  visitor.text("base_frame", base_frame, "frame of wheel_ticks and joint_states");
  visitor.real("command_rate_hz", command_rate_hz, {10.0, 200.0}, "Hz", "commands to the controller");
  visitor.real("cmd_vel_timeout_s", cmd_vel_timeout_s, {0.02, 1e-3 * base::kMaxValid_ms}, "s",
               "the wheels stop this long after the last cmd_vel");
  visitor.real("telemetry_timeout_s", telemetry_timeout_s, {0.02, 5.0}, "s",
               "without telemetry for this long cmd_vel is refused");
  visitor.real("battery_empty_V", battery_empty_V, {0.0, 60.0}, "V", "a warning below it; 0: unknown");
  visitor.real("battery_full_V", battery_full_V, {0.0, 60.0}, "V",
               "100 % of `battery`, as battery_empty_V is 0 %; 0: unknown");
  device.describe(visitor);
  visitSection(visitor, "limits", limits);
  visitList(visitor, "joints", "joint", joints, base::kMaxJoints, "number of servos");
  visitList(visitor, "ranges", "range", ranges, base::kMaxRanges, "number of range finders");
  visitList(visitor, "switches", "switch", switches, 16, "number of switches");
  visitList(visitor, "actuators", "actuator", actuators, base::kMaxActuators, "number of actuators");
}

}  // namespace stereo_nav::ros_io
