#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "navigation/control/path_driver.h"
#include "navigation/navigator/motion_check.h"
#include "navigation/navigator/progress_watch.h"
#include "navigation/navigator/recovery.h"
#include "navigation/navigator/trail.h"

namespace stereo_nav::navigator {

using control::Twist;

/// Where to go, in the frame of the map.
struct Goal {
  Eigen::Vector2d p_map = Eigen::Vector2d::Zero();
  std::optional<double> heading_rad;  ///< nothing: as the path ends
};

/// A way to the goal, or why there is none.
struct Route {
  std::vector<Eigen::Vector2d> points_map;  ///< from the base on; empty: no way
  std::string reason;                       ///< for people, where there is none
};

/// What finds ways: the planner behind the map and the local grid.
class RoutePlanner {
 public:
  virtual ~RoutePlanner() = default;

  virtual Route plan(const Eigen::Isometry2d& T_map_base, const Goal& goal) = 0;
  /// Whether nothing is in the way on the rest of a route.
  virtual bool isFree(const std::vector<Eigen::Vector2d>& points_map) = 0;
  /// Forgets the obstacles that are not seen any more.
  virtual void clear() = 0;
};

/// When it stops, slows down and plans anew.
struct NavigatorParams {
  control::ControlParams control;
  MotionCheckParams check;
  ProgressParams progress;
  RecoveryParams recovery;
  double odometry_timeout_s = 0.2, surroundings_timeout_s = 0.25;
  double slow_above_sigma_m = 0.1, stop_above_sigma_m = 0.5;
  double blocked_patience_s = 2.0;
  double look_at_route_every_s = 0.5;
  double goal_tolerance_m = 0.05;
  double jump_m = 0.1;  ///< of map->odom: a larger one is planned anew after

  void describe(ParameterVisitor& visitor);
};

/// All that is known in a period.
struct Situation {
  double now_s = 0.0;
  control::DriveState state;  ///< frame odom
  double odometry_stamp_s = 0.0;
  Eigen::Isometry2d T_map_odom = Eigen::Isometry2d::Identity();
  bool localisation_lost = false;
  double position_sigma_m = 0.0;  ///< of base_link in the map
  const Surroundings* surroundings = nullptr;
  double surroundings_stamp_s = 0.0;
};

enum class NavigatorMode { kIdle, kDriving, kRecovering, kArrived, kFailed };

/// Takes a base to a goal: plans, follows, stops for what is in its way or silent, tries to get on, and says
/// what it does. It drives in the frame odom, which does not jump.
class Navigator {
 public:
  /// `planner` must outlive the navigator.
  Navigator(const NavigatorParams& params, RoutePlanner& planner);

  void setGoal(const Goal& goal);
  /// Gives the goal up; the base stops.
  void cancel();

  /// The command for the coming period.
  Twist update(const Situation& situation);

  NavigatorMode mode() const { return mode_; }
  /// What it does and why, in words.
  const std::string& words() const { return words_; }

 private:
  std::optional<std::string> reasonToStop(const Situation& situation) const;
  double speedLimit(const Situation& situation) const;
  Twist goOn(const Situation& situation);
  void followFrameJump(const Situation& situation);
  void planNow(const Situation& situation);
  void lookAtRoute(const Situation& situation);
  void recover(const Situation& situation, const std::string& why);
  void beginStep(RecoveryStep step, const Situation& situation);
  Twist driveTwist(const Situation& situation);
  Twist recoveryTwist(const Situation& situation);
  Twist checked(const Twist& wanted, const Situation& situation);
  void fail(const std::string& why);
  bool nearGoal(const Situation& situation) const;

  NavigatorParams params_;
  RoutePlanner& planner_;
  MotionCheck check_;
  ProgressWatch progress_;
  Recovery recovery_;
  Trail trail_;
  std::optional<Goal> goal_;
  NavigatorMode mode_ = NavigatorMode::kIdle;
  std::string words_ = "waits for a goal";
  std::unique_ptr<control::PathDriver> driver_;
  std::unique_ptr<ReverseDriver> reverse_;
  Eigen::Isometry2d T_map_odom_ = Eigen::Isometry2d::Identity();  ///< with which the path was put into odom
  Eigen::Vector2d recovered_at_ = Eigen::Vector2d::Zero();
  double step_ends_s_ = 0.0, turned_rad_ = 0.0, last_heading_rad_ = 0.0;
  double looked_s_ = 0.0;
  std::optional<double> blocked_since_s_;
  std::optional<Twist> asked_;  ///< by the driver, in this period
  bool watching_ = false;
};

}  // namespace stereo_nav::navigator
