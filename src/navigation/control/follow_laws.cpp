#include "navigation/control/follow_laws.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "core/planar_motion.h"

namespace stereo_nav::control {
namespace {

Eigen::Vector2d direction(double heading_rad) {
  return {std::cos(heading_rad), std::sin(heading_rad)};
}

/// The speed to ask for now, so that a drive with this lag has the wanted one at the end of the period.
double leadingSpeed(const FollowInput& input) {
  return std::max(0.0, input.speed_m_per_s + input.lag_s * input.acceleration_m_per_s2);
}

/// The place on the path when the lag is over.
PathPoint afterLag(const FollowInput& input) {
  return input.path.at(input.arc_m + input.lag_s * input.speed_m_per_s);
}

/// The place `ahead_m` further; beyond its end the path goes on along its last direction.
Eigen::Vector2d placeAhead(const Path& path, double arc_m) {
  const PathPoint point = path.at(arc_m);
  const double beyond_m = std::max(0.0, arc_m - path.length_m());
  return point.position + beyond_m * direction(point.heading_rad);
}

}  // namespace

void HolonomicParams::describe(ParameterVisitor& visitor) {
  visitor.real("position_gain_per_s", position_gain_per_s, {0.0, 50.0}, "1/s",
               "speed towards the path for each metre of distance from it");
  visitor.real("heading_gain_per_s", heading_gain_per_s, {0.0, 50.0}, "1/s",
               "turning rate for each radian of error");
  visitor.real("max_correction_m_per_s", max_correction_m_per_s, {0.0, 10.0}, "m/s",
               "fastest motion towards the path");
}

Twist holonomicTwist(const HolonomicParams& params, const FollowInput& input) {
  const PathPoint here = input.path.at(input.arc_m);
  const double left_m = input.path.leftOf(input.state.T_world_base.translation(), input.arc_m);
  const double most = params.max_correction_m_per_s;
  const Eigen::Vector2d velocity =
      leadingSpeed(input) * direction(afterLag(input).heading_rad) +
      std::clamp(-params.position_gain_per_s * left_m, -most, most) * direction(here.heading_rad + 0.5 * kPi);
  const double heading_rad = input.state.heading_rad();
  const double turn_rate = input.turning_per_m * input.speed_m_per_s +
                           params.heading_gain_per_s * wrapRadians(input.heading_rad - heading_rad);
  // The drive's velocities lag in its own axes, which turn meanwhile.
  const double heading_after_lag_rad = heading_rad + input.lag_s * input.state.twist.z();
  const Twist twist = kinematics::fromField({velocity.x(), velocity.y(), turn_rate}, heading_after_lag_rad);
  return kinematics::alongArc(twist, input.period_s);
}

void PursuitParams::describe(ParameterVisitor& visitor) {
  visitor.real("look_ahead_gain_s", look_ahead_gain_s, {0.0, 5.0}, "s", "k of the look-ahead Lf = k v + Lfc");
  visitor.real("look_ahead_m", look_ahead_m, {0.01, 5.0}, "m", "Lfc of the look-ahead Lf = k v + Lfc");
}

Twist pursuitTwist(const PursuitParams& params, const FollowInput& input) {
  const double look_ahead_m = params.look_ahead_gain_s * input.speed_m_per_s + params.look_ahead_m;
  const Eigen::Isometry2d T_world_base =
      input.state.T_world_base * expPlanar(input.state.twist * input.lag_s);
  const double arc_m = input.arc_m + input.lag_s * input.speed_m_per_s;
  const Eigen::Vector2d ahead = T_world_base.inverse() * placeAhead(input.path, arc_m + look_ahead_m);
  const double curvature = 2.0 * ahead.y() / ahead.squaredNorm();
  return {leadingSpeed(input), 0.0, curvature * input.speed_m_per_s};
}

void StanleyParams::describe(ParameterVisitor& visitor) {
  visitor.real("gain_per_s", gain_per_s, {0.0, 50.0}, "1/s",
               "k: speed towards the path for each metre of distance from it");
  visitor.real("softening_m_per_s", softening_m_per_s, {0.0, 10.0}, "m/s",
               "ks: added to the speed, so that the steering is calm when the vehicle is slow");
  visitor.real("max_steering_deg", max_steering_deg, {1.0, 85.0}, "deg", "largest angle to either side");
}

Twist stanleyTwist(const StanleyParams& params, double wheelbase_m, const FollowInput& input) {
  const Eigen::Vector2d front = input.state.T_world_base * Eigen::Vector2d(wheelbase_m, 0.0);
  const double left_m = input.path.leftOf(front, input.arc_m);
  const double heading_error_rad = wrapRadians(afterLag(input).heading_rad - input.state.heading_rad() -
                                               input.lag_s * input.state.twist.z());
  const double towards_rad =
      -std::atan(params.gain_per_s * left_m / (params.softening_m_per_s + std::abs(input.speed_m_per_s)));
  const double most_rad = kRadPerDeg * params.max_steering_deg;
  const double steering_rad = std::clamp(heading_error_rad + towards_rad, -most_rad, most_rad);
  return steeredTwist(leadingSpeed(input), steering_rad, wheelbase_m);
}

}  // namespace stereo_nav::control
