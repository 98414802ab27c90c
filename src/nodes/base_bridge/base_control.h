#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/wheel_commander.h"
#include "ros/base_bridge_params.h"
#include "sensors/base/controller/protocol.h"
#include "sensors/base/pause_guard.h"

namespace stereo_nav::nodes {

/// Decides what the next command to the controller holds: from velocities, servos and actuators that are
/// wanted, stops, and what the controller tells. Knows no ROS; times are seconds of any clock that runs on.
class BaseControl {
 public:
  BaseControl(const ros_io::BaseBridgeParams& params, const kinematics::DriveParams& drive);

  /// A velocity for the next cmd_vel_timeout_s. Returns why it is refused, or nothing.
  std::optional<std::string> setVelocity(const kinematics::Twist& twist, double now_s);
  /// Returns why it is refused, or nothing. The angle is limited to what the joint can do.
  std::optional<std::string> setJoint(std::size_t joint, double angle_rad, double now_s);
  /// `level`: -1 to 1, limited to that. It holds until the next one, a stop, or a loss of the telemetry.
  std::optional<std::string> setActuator(std::size_t actuator, double level, double now_s);

  /// Stops, until release().
  void stop();
  /// Nothing that was ordered before it moves anything afterwards: servos stay where the next telemetry says
  /// that they are.
  void release();

  /// To be called all the time. After a pause of the program the velocity from before is forgotten, and
  /// orders are refused until those that waited in the sockets are gone.
  void tick(double now_s);
  void addTelemetry(const base::Telemetry& telemetry, double now_s);
  /// The next command, one every control period; nothing before the first telemetry, which tells where the
  /// joints are, unless the base is to stop.
  std::optional<base::Command> step(double now_s);
  /// What a node that ends leaves behind: nothing moves, but nothing is latched. Nothing is to be sent where
  /// it never knew what to leave.
  std::optional<base::Command> farewell();

  /// Whether the controller is that of this robot, by the numbers of its wheels, joints, ....
  bool fits(const base::Telemetry& telemetry) const;
  /// Whether a stop holds, here or in the controller.
  bool stopped() const { return latched_ || releasing_; }
  /// Whether the controller has confirmed the latest stop() or release().
  bool confirmed(double now_s) const;
  /// Why orders are refused now; nothing while they are obeyed.
  std::optional<std::string> obstacle(double now_s) const;
  bool drives() const { return drives_; }
  std::uint64_t velocitiesRefused() const { return velocities_refused_; }
  std::uint64_t pauses() const { return guard_.pauses(); }
  /// Angles of servos and levels of actuators.
  std::uint64_t devicesRefused() const { return devices_refused_; }
  /// How often the wheels were stopped because cmd_vel fell silent while they were to turn.
  std::uint64_t velocitiesTimedOut() const { return timed_out_; }

 private:
  /// Where the joints are not known it has none, so that the controller obeys nothing in it but a stop.
  base::Command emptyCommand();
  bool hearsTelemetry(double now_s) const;
  std::optional<std::string> refusalOfDevice(double value, double now_s);
  void restActuators();
  void fillWheels(base::Command& command, double now_s);

  ros_io::BaseBridgeParams params_;
  kinematics::WheelCommander commander_;
  std::size_t wheels_;
  double period_s_;

  base::PauseGuard guard_;
  std::optional<base::Telemetry> telemetry_;
  double telemetry_s_ = 0.0;
  std::optional<kinematics::Twist> velocity_;
  double velocity_s_ = 0.0;
  std::vector<std::int32_t> joint_urad_;
  std::vector<std::int16_t> actuator_permille_;
  bool knows_joints_ = false;  ///< telemetry of this base was heard, since the latest release()
  bool latched_ = false;
  bool releasing_ = false;
  std::uint16_t order_sequence_ =
      0;  ///< of the first command with the latest stop or release that may be heard
  bool order_sent_ = true;
  bool drives_ = false;
  std::uint16_t sequence_ = 0;
  std::uint64_t velocities_refused_ = 0, devices_refused_ = 0, timed_out_ = 0;
};

}  // namespace stereo_nav::nodes
