#pragma once

#include "navigation/planner/path_planner.h"

namespace stereo_nav::navigation {

/// Keeps a path as long as it is good, so that a robot between two ways of about the same cost does not go to
/// and fro.
///
/// A way is given up when an obstacle is in it, or when another costs less by the share `better_by`. That
/// share doubles with each change to a better way until the next goal: after a few of them only obstacles
/// change the way, however the map flickers.
class Replanner {
 public:
  explicit Replanner(PathPlanner& planner) : planner_(planner), better_by_(planner.params().better_by) {}

  enum class Change { kKept, kFirst, kBlocked, kBetter, kNone };
  struct Decision {
    Change change = Change::kNone;  ///< kNone: there is no path
    std::string text;               ///< why, for people
  };

  /// A new goal: the way so far is forgotten.
  void setGoal(const Eigen::Vector2d& goal_m, std::optional<double> goal_heading_rad = std::nullopt);
  /// To be called whenever the map or the robot has changed.
  Decision update(const PlanarPose& robot);

  /// The way from the robot to the goal, or the last refusal.
  const Plan& plan() const { return plan_; }

 private:
  /// Cuts off what the robot has passed: the way then begins at the robot.
  void advanceTo(const PlanarPose& robot);
  Decision take(const Plan& plan, Change change, const std::string& text);

  PathPlanner& planner_;
  Eigen::Vector2d goal_m_ = Eigen::Vector2d::Zero();
  std::optional<double> goal_heading_rad_;
  Plan plan_;
  double better_by_;
};

}  // namespace stereo_nav::navigation
