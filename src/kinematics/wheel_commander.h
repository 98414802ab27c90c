#pragma once

#include <vector>

#include "kinematics/drive.h"

namespace stereo_nav::kinematics {

/// What the motors of a drive can do.
struct WheelLimits {
  double max_speed_m_per_s = 1.0;
  double max_acceleration_m_per_s2 = 3.0;
  double max_steering_rate_rad_per_s = 10.0;
  double idle_speed_m_per_s = 1e-3;

  void describe(ParameterVisitor& visitor);
};

/// The twist, made smaller so that no wheel exceeds the limit; its direction and its centre of rotation stay.
Twist desaturated(const Drive& drive, const Twist& twist, double max_speed_m_per_s);

/// The same motion of the contact point with the least steering from `current_rad`: turned by half a turn and
/// with the speed reversed when the angle differs by more than 90 degrees. The angle returned is continuous
/// with `current_rad`.
WheelState leastSteering(const WheelState& wanted, double current_rad);

/// Turns twists into commands for the wheels, one every control period.
class WheelCommander {
 public:
  /// Throws ParameterError as Drive does, and when a limit is out of range.
  WheelCommander(const DriveParams& drive, const WheelLimits& limits);

  /// `twist`: wanted over the coming period, as seen at its start. `steering_rad`: measured angles of all
  /// wheels (0 for those that are not steered). In order: arc of the period, what the drive can do,
  /// desaturation, least steering, steering rate, cosine of the steering error, acceleration (one factor for
  /// all wheels).
  std::vector<WheelState> command(const Twist& twist, double period_s,
                                  const std::vector<double>& steering_rad);

  /// The same where angles are not measured: they are taken to be those commanded last.
  std::vector<WheelState> command(const Twist& twist, double period_s);

  /// The wheels were stopped by other means: the next command accelerates from rest. Angles stay.
  void halt();

 private:
  Drive drive_;
  WheelLimits limits_;
  std::vector<WheelState> last_;
};

}  // namespace stereo_nav::kinematics
