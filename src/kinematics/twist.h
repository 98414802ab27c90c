#pragma once

#include <Eigen/Core>

namespace stereo_nav::kinematics {

/// Velocity of base_link in its own axes: forward m/s, left m/s, counterclockwise rad/s.
using Twist = Eigen::Vector3d;

/// The twist of base_link when the point `centre` (m, base_link) moves with `twist`.
Twist aboutPoint(const Twist& twist, const Eigen::Vector2d& centre);

/// A velocity in the axes of the field, seen from a base whose heading in the field is yaw_rad.
Twist fromField(const Twist& twist_field, double yaw_rad);

/// The constant twist that takes the base, within period_s, to where `twist` points: straight ahead along its
/// linear part as seen at the start, turned by its angular part. A twist that is held unchanged while the
/// base turns follows an arc and arrives beside that point, by half the angle turned times the distance.
Twist alongArc(const Twist& twist, double period_s);

}  // namespace stereo_nav::kinematics
