#include "kinematics/twist.h"

#include <Eigen/Geometry>

#include "core/planar_motion.h"

namespace stereo_nav::kinematics {

Twist aboutPoint(const Twist& twist, const Eigen::Vector2d& centre) {
  return {twist.x() + twist.z() * centre.y(), twist.y() - twist.z() * centre.x(), twist.z()};
}

Twist fromField(const Twist& twist_field, double yaw_rad) {
  Twist twist = twist_field;
  twist.head<2>() = Eigen::Rotation2Dd(-yaw_rad) * twist_field.head<2>();
  return twist;
}

Twist alongArc(const Twist& twist, double period_s) {
  if (!(period_s > 0.0)) return twist;
  Eigen::Isometry2d T_start_end = Eigen::Isometry2d::Identity();
  T_start_end.linear() = Eigen::Rotation2Dd(twist.z() * period_s).toRotationMatrix();
  T_start_end.translation() = twist.head<2>() * period_s;
  Twist arc = logPlanar(T_start_end) / period_s;
  arc.z() = twist.z();  // also for more than half a turn within the period
  return arc;
}

}  // namespace stereo_nav::kinematics
