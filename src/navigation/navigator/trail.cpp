#include "navigation/navigator/trail.h"

#include "core/angles.h"

namespace stereo_nav::navigator {
namespace {

constexpr double kTrailSpacing_m = 0.02;
constexpr double kJump_m = 1.0;  ///< further than a base drives between two odometries

control::ControlParams backwards(control::ControlParams params, double speed_m_per_s) {
  params.law = control::FollowLaw::kPursuit;
  params.speed.max_speed_m_per_s = speed_m_per_s;
  params.goal.turn_on_spot_above_deg = 360.0;  // it leaves as it came
  return params;
}

control::Twist turnedHalf(const control::Twist& twist) {
  return {-twist.x(), -twist.y(), twist.z()};
}

}  // namespace

bool Trail::add(const Eigen::Vector2d& p_odom) {
  const bool jumped = !points_.empty() && (points_.back() - p_odom).norm() > kJump_m;
  if (jumped) points_.clear();
  if (!points_.empty() && (points_.back() - p_odom).norm() < kTrailSpacing_m) return false;
  points_.push_back(p_odom);
  while (static_cast<double>(points_.size()) * kTrailSpacing_m > most_m_) points_.pop_front();
  return jumped;
}

std::vector<Eigen::Vector2d> Trail::back(double length_m) const {
  std::vector<Eigen::Vector2d> points;
  double way_m = 0.0;
  for (auto point = points_.rbegin(); point != points_.rend() && way_m < length_m; ++point) {
    if (!points.empty()) way_m += (points.back() - *point).norm();
    points.push_back(*point);
  }
  return points;
}

ReverseDriver::ReverseDriver(const control::ControlParams& params, const std::vector<Eigen::Vector2d>& points,
                             double speed_m_per_s)
    : driver_(backwards(params, speed_m_per_s), control::Path(points)) {}

control::Twist ReverseDriver::command(const control::DriveState& state, double stamp_s, double now_s) {
  control::DriveState turned = state;
  turned.T_world_base.rotate(kPi);
  turned.twist = turnedHalf(state.twist);
  return turnedHalf(driver_.command(turned, stamp_s, now_s));
}

}  // namespace stereo_nav::navigator
