#pragma once

#include "navigation/control/drive_model.h"
#include "navigation/control/path.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::control {

/// What a law of following gets: the situation at the moment from which on its command will act.
struct FollowInput {
  const Path& path;
  double arc_m = 0.0;                  ///< where on the path the reference point is
  DriveState state;                    ///< path's frame
  double speed_m_per_s = 0.0;          ///< along the path, at the end of the coming period
  double acceleration_m_per_s2 = 0.0;  ///< of that speed
  double lag_s = 0.0;                  ///< with which the drive will follow
  double period_s = 0.02;
  double heading_rad = 0.0;    ///< wanted of a holonomic base, here
  double turning_per_m = 0.0;  ///< change of that heading along the path, when the lag is over
};

/// A base that moves in any direction, with any heading: swerve, mecanum, omni.
struct HolonomicParams {
  double position_gain_per_s = 3.0;
  double heading_gain_per_s = 4.0;
  double max_correction_m_per_s = 0.3;

  void describe(ParameterVisitor& visitor);
};
/// Feed-forward of the path's motion, and velocities in proportion to the distance from the path and to the
/// error of the heading.
Twist holonomicTwist(const HolonomicParams& params, const FollowInput& input);

/// A base that moves where it looks, and turns on the spot.
struct PursuitParams {
  double look_ahead_gain_s = 0.1;  ///< k of Lf = k v + Lfc
  double look_ahead_m = 0.12;      ///< Lfc

  void describe(ParameterVisitor& visitor);
};
/// Pure pursuit (Coulter 1992): the arc through the point that lies Lf = k v + Lfc ahead, measured along the
/// path, with the speed that the profile regulates (Macenski et al. 2023, "Regulated pure pursuit"). Beyond
/// its end the path goes on straight.
Twist pursuitTwist(const PursuitParams& params, const FollowInput& input);

/// A vehicle with steered front wheels. Its reference point is the middle of the front axle.
struct StanleyParams {
  double gain_per_s = 2.0;         ///< k
  double softening_m_per_s = 0.3;  ///< ks
  double max_steering_deg = 40.0;

  void describe(ParameterVisitor& visitor);
};
/// Steering by heading error and distance of the front axle (Hoffmann et al. 2007, "Autonomous automobile
/// trajectory tracking for off-road driving", eq. 5 with the softening of section IV).
Twist stanleyTwist(const StanleyParams& params, double wheelbase_m, const FollowInput& input);

}  // namespace stereo_nav::control
