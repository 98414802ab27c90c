#include "sim/motion_history.h"

#include <algorithm>
#include <cmath>

#include "core/planar_motion.h"

namespace stereo_nav::sim {
namespace {

constexpr double kKept_s = 0.5;

Eigen::Vector2d velocityInWorld(const Eigen::Isometry2d& T_world_base, const kinematics::Twist& twist) {
  return T_world_base.linear() * twist.head<2>();
}

}  // namespace

MotionHistory::MotionHistory(const Eigen::Isometry2d& T_world_base, double step_s)
    : step_s_(step_s), now_(T_world_base) {}

void MotionHistory::add(const kinematics::Twist& twist) {
  steps_.push_back({now_, twist});
  now_ = now_ * expPlanar(twist * step_s_);
  ++done_;
  if (static_cast<double>(steps_.size()) * step_s_ > kKept_s) steps_.pop_front();
}

std::pair<std::size_t, double> MotionHistory::stepAt(double time_s) const {
  const double first_s = static_cast<double>(done_ - steps_.size()) * step_s_;
  const double steps = std::max(0.0, (time_s - first_s) / step_s_);
  const auto index = std::min(static_cast<std::size_t>(steps), steps_.size() - 1);
  return {index, std::min(steps - static_cast<double>(index), 1.0) * step_s_};
}

Eigen::Isometry3d MotionHistory::pose(double time_s) const {
  if (steps_.empty()) return inSpace(now_);
  const auto [index, passed_s] = stepAt(time_s);
  return inSpace(steps_[index].T_world_base * expPlanar(steps_[index].twist * passed_s));
}

BaseState MotionHistory::state(double time_s) const {
  BaseState state;
  state.T_world_base = pose(time_s);
  if (steps_.empty()) return state;
  const std::size_t index = stepAt(time_s).first;
  const Step& step = steps_[index];
  state.velocity_base.head<2>() = step.twist.head<2>();
  state.angular_velocity_base.z() = step.twist.z();
  const Step& before = steps_[index > 0 ? index - 1 : 0];
  state.acceleration_world.head<2>() =
      (velocityInWorld(step.T_world_base, step.twist) - velocityInWorld(before.T_world_base, before.twist)) /
      step_s_;
  return state;
}

}  // namespace stereo_nav::sim
