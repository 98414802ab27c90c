#pragma once

#include <string>
#include <vector>

#include "core/rig_file.h"
#include "kinematics/wheel_commander.h"
#include "sensors/base/base_device.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::ros_io {

/// About which axis of its own frame a joint turns, at an angle of zero.
enum class JointAxis { kRoll, kPitch, kYaw };

/// A servo: its angle is on joint_states, and commanded on joints/NAME. In tf it is the frame NAME_link.
struct BaseJointParams {
  std::string name = "joint";
  double min_deg = -90.0;
  double max_deg = 90.0;
  JointAxis axis = JointAxis::kPitch;
  bool carries_camera = false;  ///< the stereo rig turns with it
  SensorMounting mounting;      ///< at an angle of zero

  void describe(ParameterVisitor& visitor);
};

/// A range finder of the microcontroller: range/NAME.
struct BaseRangeParams {
  std::string name = "range";
  std::string frame_id;  ///< empty: range_NAME
  bool ultrasound = false;
  double field_of_view_deg = 3.6;
  double min_range_m = 0.1;
  double max_range_m = 12.0;
  SensorMounting mounting;

  std::string frame() const { return frame_id.empty() ? "range_" + name : frame_id; }
  void describe(ParameterVisitor& visitor);
};

/// A switch (switch/NAME) or an actuator (actuators/NAME).
struct BaseNameParams {
  std::string name = "unnamed";

  void describe(ParameterVisitor& visitor);
};

/// Parameters of the base_bridge node: section `base` of the rig file. Those of the device are among them,
/// without a section.
struct BaseBridgeParams {
  std::string port = "/dev/ttyACM0";
  std::string by_id_directory = "/dev/serial/by-id";
  std::string base_frame = "base_link";
  double command_rate_hz = 50.0;
  double cmd_vel_timeout_s = 0.3;
  double telemetry_timeout_s = 0.3;
  double battery_empty_V = 0.0;
  double battery_full_V = 0.0;
  base::BaseDeviceParams device;
  kinematics::WheelLimits limits;
  std::vector<BaseJointParams> joints;
  std::vector<BaseRangeParams> ranges;
  std::vector<BaseNameParams> switches, actuators;

  /// Throws ParameterError where two of one kind have the same name, or one has a name that no topic can
  /// have.
  void checkNames() const;
  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::ros_io
