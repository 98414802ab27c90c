#pragma once

#include <optional>
#include <string>

#include "kinematics/twist.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::nodes {

struct TeleopParams {
  double speed_m_per_s = 0.5;
  double turn_rad_per_s = 1.0;
  bool field_centric = false;
  double repeat_delay_s = 0.6;
  double hold_s = 0.2;
  double rate_hz = 20.0;
  double odom_timeout_s = 0.5;

  void describe(ParameterVisitor& visitor);
};

/// Keys become velocities, with the keys of teleop_twist_keyboard. The key is the dead man's switch: a
/// terminal repeats a key that is held, and when the repetitions end the velocity is zero. The terminal
/// begins to repeat after repeat_delay_s, up to which the first press lasts. Knows no ROS; times are seconds
/// of any clock that runs on.
class KeyDriver {
 public:
  explicit KeyDriver(const TeleopParams& params);

  /// A key; returns what to tell the user, where that changed.
  std::optional<std::string> press(char key, double now_s);
  /// The heading of the base in the field (rad), for field-centric driving.
  void setHeading(double yaw_rad, double now_s);

  /// The velocity to publish now; nothing while no key is held, after one zero velocity.
  std::optional<kinematics::Twist> velocity(double now_s);
  /// Whether keys have no effect because field-centric driving lacks the heading.
  bool lacksHeading(double now_s) const;
  std::string speeds() const;

 private:
  TeleopParams params_;
  kinematics::Twist direction_ = kinematics::Twist::Zero();  ///< of the key that is held, each -1, 0 or 1
  double held_until_s_ = -1e18;
  double pressed_s_ = -1e18;
  char last_key_ = 0;
  bool is_driving_ = false;
  double yaw_rad_ = 0.0;
  double heading_s_ = -1e18;
};

/// The keys, for the user.
std::string keyHelp();

}  // namespace stereo_nav::nodes
