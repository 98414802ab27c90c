#pragma once

#include <Eigen/Geometry>
#include <deque>

#include "kinematics/twist.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::control {

using kinematics::Twist;

/// How a base answers commands of velocity: nothing for a dead time, then a first-order lag within limits.
/// The defaults are the drive on which the followers of docs/driving.md are measured.
struct DriveModelParams {
  double dead_time_s = 0.04;
  double lag_s = 0.08;
  double max_acceleration_m_per_s2 = 3.0;  ///< of the velocity as a vector in the axes of the base
  double max_turn_acceleration_rad_per_s2 = 12.0;
  /// Distance between the axles of a vehicle with steered front wheels; 0 for every other base.
  double wheelbase_m = 0.0;
  double steering_lag_s = 0.08;
  double max_steering_rate_rad_per_s = 3.0;

  bool steered() const { return wheelbase_m > 0.0; }
  void describe(ParameterVisitor& visitor);
};

/// Where a base is and how it moves.
struct DriveState {
  Eigen::Isometry2d T_world_base = Eigen::Isometry2d::Identity();
  Twist twist = Twist::Zero();  ///< m/s, m/s, rad/s in the axes of the base
  double steering_rad = 0.0;    ///< of the front wheels of a steered vehicle

  double heading_rad() const;
};

/// Steering angle whose circle a twist describes: tan(angle) = wheelbase * turning rate / speed (bicycle
/// model). A twist without speed has none; then `otherwise_rad`.
double steeringOf(const Twist& twist, double wheelbase_m, double otherwise_rad);

/// The twist of the rear axle of a vehicle with this speed and steering angle.
Twist steeredTwist(double speed_m_per_s, double steering_rad, double wheelbase_m);

/// The state after `duration_s` in which the drive follows `command` without dead time; in steps of 5 ms at
/// most.
DriveState advanced(const DriveModelParams& params, DriveState state, const Twist& command,
                    double duration_s);

/// The commands that a drive was given, each with the time from which on it acts.
class CommandHistory {
 public:
  explicit CommandHistory(const DriveModelParams& params) : params_(params) {}

  /// A command given at `time_s`, not before the one before it. Those that ceased to act more than a second
  /// before are forgotten.
  void add(double time_s, const Twist& command);
  /// What was given in place of the last command, if it was given at that time.
  void replaceLast(double time_s, const Twist& command);

  /// The state at `until_s` of a drive that was in `state` at `stamp_s` (Smith predictor: the drive's model
  /// runs with the commands that are under way). The state itself when `until_s` is not later.
  DriveState predicted(const DriveState& state, double stamp_s, double until_s) const;

 private:
  struct Entry {
    double from_s;
    Twist command;
  };

  DriveModelParams params_;
  std::deque<Entry> commands_;
};

}  // namespace stereo_nav::control
