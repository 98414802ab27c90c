#include "navigation/control/path_driver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angles.h"

namespace stereo_nav::control {
namespace {

constexpr double kSearchBack_m = 0.1;    ///< the nearest place may move back by noise, not to an earlier lap
constexpr double kSearchAhead_m = 0.5;   ///< more than any base covers in a period
constexpr double kCreep_m_per_s = 0.02;  ///< slowest motion towards the end
constexpr double kEndShare = 0.3;        ///< of the tolerance: nearer to the end the base stops
constexpr double kTurned_deg = 3.0;
constexpr double kStanding_rad_per_s = 0.05;

SpeedLimits turnLimits(const SpeedLimits& limits) {
  SpeedLimits turn;
  turn.max_acceleration_m_per_s2 = turn.max_braking_m_per_s2 = limits.max_turn_acceleration_rad_per_s2;
  return turn;
}

Path moved(const Path& path, const Eigen::Isometry2d& T_new_old) {
  std::vector<Eigen::Vector2d> points;
  for (const auto& point : path.points()) points.push_back(T_new_old * point.position);
  return Path(points);
}

}  // namespace

void ControlParams::describe(ParameterVisitor& visitor) {
  visitEnum(visitor, "law", law,
            {{"holonomic", FollowLaw::kHolonomic},
             {"pursuit", FollowLaw::kPursuit},
             {"stanley", FollowLaw::kStanley}},
            "holonomic: swerve, mecanum and omni drives; pursuit: differential drives; stanley: Ackermann");
  visitEnum(visitor, "heading", heading,
            {{"along_path", HeadingMode::kAlongPath}, {"towards_goal", HeadingMode::kTowardsGoal}},
            "where a holonomic base looks while it drives");
  visitor.real("period_s", period_s, {0.001, 1.0}, "s", "between two commands");
  visitSection(visitor, "drive", drive);
  visitSection(visitor, "speed", speed);
  visitSection(visitor, "holonomic", holonomic);
  visitSection(visitor, "pursuit", pursuit);
  visitSection(visitor, "stanley", stanley);
  visitSection(visitor, "goal", goal);
}

std::string nameOf(DrivePhase phase) {
  switch (phase) {
    case DrivePhase::kTurningToPath:
      return "turning to the path";
    case DrivePhase::kFollowing:
      return "following the path";
    case DrivePhase::kTurningToGoal:
      return "turning to the goal's heading";
    case DrivePhase::kArrived:
      return "arrived";
    case DrivePhase::kMissed:
      return "at the end of the path, beside the goal";
  }
  return "";
}

PathDriver::PathDriver(const ControlParams& params, const Path& path,
                       const std::optional<double>& goal_heading_rad,
                       const std::optional<WheelSpeedLimit>& wheels)
    : params_(params),
      path_(path),
      profile_(path, params.speed, wheels),
      governor_(params.speed),
      turn_governor_(turnLimits(params.speed)),
      history_(params.drive),
      goal_check_(params.goal),
      goal_heading_rad_(goal_heading_rad.value_or(path.points().back().heading_rad)),
      most_m_per_s_(std::numeric_limits<double>::infinity()) {}

Twist PathDriver::command(const DriveState& state, double stamp_s, double now_s) {
  const DriveState acting = history_.predicted(state, stamp_s, now_s + params_.drive.dead_time_s);
  if (!phase_) start(acting);
  advancePhase(acting);
  Twist twist = twistOf(acting);
  history_.add(now_s, twist);
  return twist;
}

void PathDriver::start(const DriveState& state) {
  start_heading_rad_ = state.heading_rad();
  governor_.reset(std::max(0.0, state.twist.x()));
  turn_governor_.reset(state.twist.z());
  const double error_rad = std::abs(headingError(state, path_.at(0.0).heading_rad));
  const bool turn = params_.law == FollowLaw::kPursuit || params_.heading == HeadingMode::kAlongPath;
  phase_ = turn && canTurnOnSpot() && error_rad > kRadPerDeg * params_.goal.turn_on_spot_above_deg
               ? DrivePhase::kTurningToPath
               : DrivePhase::kFollowing;
}

double PathDriver::headingError(const DriveState& state, double heading_rad) const {
  return wrapRadians(heading_rad - state.heading_rad());
}

void PathDriver::advancePhase(const DriveState& state) {
  const Eigen::Vector2d reference = state.T_world_base * Eigen::Vector2d(params_.reference_m(), 0.0);
  arc_m_ = path_.nearestArc(reference, arc_m_ - kSearchBack_m, arc_m_ + kSearchAhead_m);
  const double distance_m = (reference - path_.points().back().position).norm();
  if (phase_ == DrivePhase::kTurningToPath) {
    const double error_rad = std::abs(headingError(state, path_.at(arc_m_).heading_rad));
    if (error_rad < kRadPerDeg * kTurned_deg && std::abs(state.twist.z()) < kStanding_rad_per_s)
      phase_ = DrivePhase::kFollowing;
  } else if (phase_ == DrivePhase::kFollowing) {
    if (path_.length_m() - arc_m_ < kEndShare * params_.goal.position_tolerance_m) endPath(state, distance_m);
  } else if (phase_ == DrivePhase::kTurningToGoal) {
    const bool still = std::abs(state.twist.z()) < kStanding_rad_per_s;
    if (goal_check_.update(distance_m, headingError(state, goal_heading_rad_)) && still)
      phase_ = DrivePhase::kArrived;
  }
}

void PathDriver::endPath(const DriveState& state, double distance_m) {
  turn_governor_.reset(state.twist.z());
  goal_check_.update(distance_m, headingError(state, goal_heading_rad_));
  const bool correctable = params_.law == FollowLaw::kHolonomic;
  if (!goal_check_.positionReached() && !correctable) {
    phase_ = DrivePhase::kMissed;
  } else {
    phase_ = canTurnOnSpot() ? DrivePhase::kTurningToGoal : DrivePhase::kArrived;
  }
}

Twist PathDriver::twistOf(const DriveState& state) {
  switch (*phase_) {
    case DrivePhase::kTurningToPath:
      return turningTwist(state, path_.at(arc_m_).heading_rad);
    case DrivePhase::kFollowing:
      return followingTwist(state);
    case DrivePhase::kTurningToGoal:
      return endTwist(state);
    case DrivePhase::kArrived:
    case DrivePhase::kMissed:
      break;
  }
  return Twist::Zero();
}

Twist PathDriver::followingTwist(const DriveState& state) {
  const double at_end_of_period_m = arc_m_ + governor_.speed_m_per_s() * params_.period_s;
  const double limit = std::max(kCreep_m_per_s, profile_.limit(at_end_of_period_m));
  FollowInput input{path_, arc_m_, state};
  input.speed_m_per_s = governor_.next(std::min(limit, most_m_per_s_), params_.period_s);
  input.acceleration_m_per_s2 = governor_.acceleration();
  input.lag_s = params_.drive.steered() ? params_.drive.steering_lag_s : params_.drive.lag_s;
  input.period_s = params_.period_s;
  input.heading_rad = wantedHeading(arc_m_);
  input.turning_per_m = wantedTurning(arc_m_ + input.lag_s * input.speed_m_per_s);
  switch (params_.law) {
    case FollowLaw::kHolonomic:
      return holonomicTwist(params_.holonomic, input);
    case FollowLaw::kPursuit:
      return pursuitTwist(params_.pursuit, input);
    case FollowLaw::kStanley:
      return stanleyTwist(params_.stanley, params_.drive.wheelbase_m, input);
  }
  return Twist::Zero();
}

Twist PathDriver::turningTwist(const DriveState& state, double heading_rad) {
  const double rate = turnRateTowards(headingError(state, heading_rad), params_.goal, params_.speed);
  return {0.0, 0.0, turn_governor_.next(rate, params_.period_s)};
}

Twist PathDriver::endTwist(const DriveState& state) {
  Twist twist = turningTwist(state, goal_heading_rad_);
  if (params_.law != FollowLaw::kHolonomic) return twist;
  const Eigen::Vector2d left = state.T_world_base.inverse() * path_.points().back().position;
  const double speed = params_.holonomic.position_gain_per_s * left.norm();
  const double most = std::min(params_.holonomic.max_correction_m_per_s, most_m_per_s_);
  twist.head<2>() = std::min(speed, most) * left.normalized();
  return kinematics::alongArc(twist, params_.period_s);
}

double PathDriver::wantedHeading(double arc_m) const {
  if (params_.heading == HeadingMode::kAlongPath) return path_.at(arc_m).heading_rad;
  return start_heading_rad_ + wantedTurning(arc_m) * std::clamp(arc_m, 0.0, path_.length_m());
}

double PathDriver::wantedTurning(double arc_m) const {
  if (params_.heading == HeadingMode::kAlongPath) return path_.at(arc_m).curvature_per_m;
  return wrapRadians(goal_heading_rad_ - start_heading_rad_) / path_.length_m();
}

void PathDriver::wasGiven(const Twist& twist, double now_s) {
  history_.replaceLast(now_s, twist);
  governor_.reset(std::min(governor_.speed_m_per_s(), twist.head<2>().norm()));
  turn_governor_.reset(
      std::copysign(std::min(std::abs(turn_governor_.speed_m_per_s()), std::abs(twist.z())), twist.z()));
}

void PathDriver::reanchor(const Eigen::Isometry2d& T_new_old) {
  const double turned_rad = std::atan2(T_new_old.linear()(1, 0), T_new_old.linear()(0, 0));
  path_ = moved(path_, T_new_old);
  goal_heading_rad_ += turned_rad;
  start_heading_rad_ += turned_rad;
}

}  // namespace stereo_nav::control
