#include "navigation/navigator/progress_watch.h"

#include <cmath>

#include "core/angles.h"

namespace stereo_nav::navigator {

void ProgressParams::describe(ParameterVisitor& visitor) {
  visitor.real("patience_s", patience_s, {0.5, 120.0}, "s", "so long without progress means stuck");
  visitor.real("way_m", way_m, {0.01, 5.0}, "m", "a way that is progress");
  visitor.real("turn_deg", turn_deg, {1.0, 180.0}, "deg", "a turn that is progress");
}

void ProgressWatch::restart(double now_s, const Eigen::Isometry2d& T_odom_base) {
  since_s_ = now_s;
  T_odom_mark_ = T_odom_base;
}

bool ProgressWatch::stuck(double now_s, const Eigen::Isometry2d& T_odom_base) {
  const Eigen::Isometry2d T_mark_base = T_odom_mark_.inverse() * T_odom_base;
  const double turn_rad = std::atan2(T_mark_base.linear()(1, 0), T_mark_base.linear()(0, 0));
  if (T_mark_base.translation().norm() >= params_.way_m ||
      std::abs(turn_rad) >= kRadPerDeg * params_.turn_deg)
    restart(now_s, T_odom_base);
  return now_s - since_s_ > params_.patience_s;
}

}  // namespace stereo_nav::navigator
