#include "navigation/navigator/navigator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::navigator {
namespace {

constexpr double kTrail_m = 3.0;
constexpr double kClearing_s = 0.5;     ///< time for the grid to be filled anew
constexpr double kSmallJump_m = 0.005;  ///< of map->odom, which is not followed

std::vector<Eigen::Vector2d> moved(const std::vector<Eigen::Vector2d>& points, const Eigen::Isometry2d& T) {
  std::vector<Eigen::Vector2d> result;
  for (const auto& point : points) result.push_back(T * point);
  return result;
}

}  // namespace

Navigator::Navigator(const NavigatorParams& params, RoutePlanner& planner)
    : params_(params),
      planner_(planner),
      check_(params.check, params.control.drive),
      progress_(params.progress),
      recovery_(params.recovery, !params.control.drive.steered()),
      trail_(kTrail_m) {}

void Navigator::setGoal(const Goal& goal) {
  goal_ = goal;
  mode_ = NavigatorMode::kDriving;
  driver_.reset();
  reverse_.reset();
  recovery_.reset();
  blocked_since_s_.reset();
  watching_ = false;
}

void Navigator::cancel() {
  goal_.reset();
  driver_.reset();
  reverse_.reset();
  mode_ = NavigatorMode::kIdle;
  words_ = "the goal was given up";
}

Twist Navigator::update(const Situation& situation) {
  if (trail_.add(situation.state.T_world_base.translation())) {
    driver_.reset();  // the path is where the base was; it plans anew
    reverse_.reset();
  }
  if (mode_ != NavigatorMode::kDriving && mode_ != NavigatorMode::kRecovering) return Twist::Zero();
  Twist twist = Twist::Zero();
  asked_.reset();
  if (const auto reason = reasonToStop(situation)) {
    words_ = "stands: " + *reason;
    watching_ = false;  // standing for a reason is not being stuck
  } else {
    twist = goOn(situation);
  }
  if (driver_ && (!asked_ || *asked_ != twist)) driver_->wasGiven(twist, situation.now_s);
  return twist;
}

std::optional<std::string> Navigator::reasonToStop(const Situation& situation) const {
  const double odometry_age_s = situation.now_s - situation.odometry_stamp_s;
  const double surroundings_age_s = situation.now_s - situation.surroundings_stamp_s;
  if (odometry_age_s > params_.odometry_timeout_s)
    return fmt::format("no odometry for {:.1f} s; is the odometry's node running?", odometry_age_s);
  if (situation.localisation_lost) return "the localisation is lost; it goes on when it is found again";
  if (situation.position_sigma_m >= params_.stop_above_sigma_m)
    return fmt::format("the position is known to {:.2f} m only", situation.position_sigma_m);
  if (situation.surroundings == nullptr) return "there is no local grid yet; do cameras or laser deliver?";
  if (surroundings_age_s > params_.surroundings_timeout_s)
    return fmt::format("the local grid is {:.1f} s old; have cameras and laser gone silent?",
                       surroundings_age_s);
  return std::nullopt;
}

double Navigator::speedLimit(const Situation& situation) const {
  const double share = (params_.stop_above_sigma_m - situation.position_sigma_m) /
                       (params_.stop_above_sigma_m - params_.slow_above_sigma_m);
  return params_.control.speed.max_speed_m_per_s * std::clamp(share, 0.1, 1.0);
}

Twist Navigator::goOn(const Situation& situation) {
  const Eigen::Isometry2d& T_odom_base = situation.state.T_world_base;
  if (!watching_) progress_.restart(situation.now_s, T_odom_base);
  watching_ = true;
  if ((T_odom_base.translation() - recovered_at_).norm() > params_.recovery.forget_after_m) recovery_.reset();
  followFrameJump(situation);
  if (mode_ == NavigatorMode::kRecovering) return recoveryTwist(situation);
  if (!driver_) planNow(situation);
  if (driver_) lookAtRoute(situation);
  if (!driver_) return Twist::Zero();
  return driveTwist(situation);
}

void Navigator::followFrameJump(const Situation& situation) {
  const Eigen::Isometry2d T_new_old = situation.T_map_odom.inverse() * T_map_odom_;
  const Eigen::Vector2d here = situation.state.T_world_base.translation();
  const double jump_m = (T_new_old * here - here).norm();
  if (jump_m < kSmallJump_m && std::abs(yawOf(T_new_old)) < kSmallJump_m) return;
  T_map_odom_ = situation.T_map_odom;
  if (!driver_) return;
  driver_->reanchor(T_new_old);
  if (jump_m > params_.jump_m) driver_.reset();  // too far off the path to go back to it
}

void Navigator::planNow(const Situation& situation) {
  T_map_odom_ = situation.T_map_odom;
  looked_s_ = situation.now_s;
  if (nearGoal(situation) && !goal_->heading_rad) {
    mode_ = NavigatorMode::kArrived;
    words_ = "arrived";
    return;
  }
  const Route route = planner_.plan(situation.T_map_odom * situation.state.T_world_base, *goal_);
  if (route.points_map.empty()) {
    recover(situation, route.reason);
    return;
  }
  std::optional<double> heading_rad;
  if (goal_->heading_rad) heading_rad = *goal_->heading_rad - yawOf(T_map_odom_);
  try {
    const control::Path path(moved(route.points_map, T_map_odom_.inverse()));
    driver_ = std::make_unique<control::PathDriver>(params_.control, path, heading_rad);
  } catch (const InputError& error) {
    recover(situation, error.what());
  }
}

void Navigator::lookAtRoute(const Situation& situation) {
  if (situation.now_s - looked_s_ < params_.look_at_route_every_s) return;
  looked_s_ = situation.now_s;
  std::vector<Eigen::Vector2d> rest;
  for (const auto& point : driver_->path().points()) {
    if (point.arc_m >= driver_->arc_m()) rest.push_back(T_map_odom_ * point.position);
  }
  if (planner_.isFree(rest)) return;
  driver_.reset();
  planNow(situation);
}

Twist Navigator::driveTwist(const Situation& situation) {
  driver_->limitSpeed(speedLimit(situation));
  const Twist wanted = driver_->command(situation.state, situation.odometry_stamp_s, situation.now_s);
  asked_ = wanted;
  words_ = control::nameOf(driver_->phase());
  if (driver_->finished()) {
    if (driver_->phase() == control::DrivePhase::kArrived || nearGoal(situation)) {
      mode_ = NavigatorMode::kArrived;
      words_ = "arrived";
    } else {
      recover(situation, "the path ended beside the goal");
    }
    return Twist::Zero();
  }
  const Twist twist = checked(wanted, situation);
  const bool waited = blocked_since_s_ && situation.now_s - *blocked_since_s_ > params_.blocked_patience_s;
  if (waited)
    recover(situation, "the way is blocked");
  else if (progress_.stuck(situation.now_s, situation.state.T_world_base))
    recover(situation, "the base does not move");
  return mode_ == NavigatorMode::kDriving ? twist : Twist::Zero();
}

Twist Navigator::checked(const Twist& wanted, const Situation& situation) {
  const MotionCheck::Result result = check_.check(situation.state, wanted, *situation.surroundings);
  if (result.share > 0.0) {
    blocked_since_s_.reset();
    if (result.share < 1.0)
      words_ += result.by_unseen ? ", slowly: it does not see further" : ", slowly: something is near";
    return result.share * wanted;
  }
  if (!blocked_since_s_) blocked_since_s_ = situation.now_s;
  words_ =
      result.by_unseen ? "stands: it would move where it sees nothing" : "stands: something is in the way";
  return Twist::Zero();
}

void Navigator::recover(const Situation& situation, const std::string& why) {
  driver_.reset();
  reverse_.reset();
  blocked_since_s_.reset();
  recovered_at_ = situation.state.T_world_base.translation();
  const auto step = recovery_.next();
  if (!step) {
    fail(why);
    return;
  }
  mode_ = NavigatorMode::kRecovering;
  words_ = why + ": ";
  beginStep(*step, situation);
}

void Navigator::beginStep(RecoveryStep step, const Situation& situation) {
  turned_rad_ = 2.0 * kPi;  // nothing to turn
  last_heading_rad_ = situation.state.heading_rad();
  step_ends_s_ = situation.now_s + params_.recovery.most_step_s;
  if (step == RecoveryStep::kTurn) {
    turned_rad_ = 0.0;
    words_ += "it turns to look around";
    return;
  }
  const auto back = trail_.back(params_.recovery.back_off_m);
  if (step == RecoveryStep::kBackOff && back.size() > 1) {
    reverse_ =
        std::make_unique<ReverseDriver>(params_.control, back, params_.recovery.back_off_speed_m_per_s);
    words_ += "it backs off along the way that it came";
    return;
  }
  planner_.clear();
  step_ends_s_ = situation.now_s + kClearing_s;
  words_ += "old obstacles are forgotten";
}

Twist Navigator::recoveryTwist(const Situation& situation) {
  turned_rad_ += std::abs(wrapRadians(situation.state.heading_rad() - last_heading_rad_));
  last_heading_rad_ = situation.state.heading_rad();
  const bool turning = !reverse_ && turned_rad_ < 2.0 * kPi;
  Twist wanted = Twist::Zero();
  if (reverse_) wanted = reverse_->command(situation.state, situation.odometry_stamp_s, situation.now_s);
  if (turning) wanted.z() = params_.recovery.turn_rate_rad_per_s;
  const std::string words = words_;
  Twist twist = checked(wanted, situation);
  words_ = words;
  const bool blocked = blocked_since_s_ && situation.now_s - *blocked_since_s_ > params_.blocked_patience_s;
  const bool moving = turning || (reverse_ && !reverse_->finished());
  const bool clearing = !reverse_ && !turning;
  if (situation.now_s < step_ends_s_ && !blocked && (moving || clearing)) return twist;
  reverse_.reset();
  blocked_since_s_.reset();
  turned_rad_ = 2.0 * kPi;
  watching_ = false;
  mode_ = NavigatorMode::kDriving;  // which plans anew
  return Twist::Zero();
}

void Navigator::fail(const std::string& why) {
  mode_ = NavigatorMode::kFailed;
  const std::string tried = recovery_.tried();
  words_ = "the goal is not reached: " + why + (tried.empty() ? "" : "; " + tried);
}

bool Navigator::nearGoal(const Situation& situation) const {
  const Eigen::Vector2d p_map = situation.T_map_odom * situation.state.T_world_base.translation();
  return (p_map - goal_->p_map).norm() <= params_.goal_tolerance_m;
}

}  // namespace stereo_nav::navigator
