#pragma once

#include <Eigen/Core>
#include <vector>

#include "navigation/control/drive_model.h"
#include "navigation/navigator/surroundings.h"

namespace stereo_nav::navigator {

/// How far ahead motion is checked.
struct MotionCheckParams {
  double horizon_s = 1.0;
  /// Of the base, a rectangle about base_link. No parameters of their own: they follow from the outline that
  /// the planner knows.
  double length_m = 0.5, width_m = 0.5;
  double margin_m = 0.05;  ///< kept free around it
  /// Whether it may move where nothing has been seen: for a robot that is watched, or whose sensors see all
  /// around.
  bool into_unseen = false;
  /// Floor ahead that is nearer to base_link than this counts as seen, for cameras that do not see it.
  double blind_zone_m = 0.0;

  void describe(ParameterVisitor& visitor);
};

/// Holds the coming motion against what is seen, whatever a plan says: the drive's model runs with the
/// command for the horizon and brakes then; its outline must stay clear all the way. Where the base touches
/// something already, a motion is safe that touches less. The circle in which it can turn on the spot counts
/// as seen: it stands there.
class MotionCheck {
 public:
  MotionCheck(const MotionCheckParams& params, const control::DriveModelParams& drive);

  /// What was found.
  struct Result {
    double share = 1.0;      ///< of the command that is safe: 1, 0.75, 0.5, 0.25 or 0
    bool by_unseen = false;  ///< what limits it is a place that was not seen, not an obstacle
  };
  Result check(const control::DriveState& state, const control::Twist& command,
               const Surroundings& surroundings) const;

 private:
  enum class Finding { kClear, kObstacle, kUnseen };
  /// Whether each point of the outline touches something.
  std::vector<bool> touching(const Eigen::Isometry2d& T_odom_base, const Surroundings& surroundings) const;
  Finding along(const control::DriveState& state, const control::Twist& command,
                const Surroundings& surroundings, const std::vector<bool>& touches) const;
  /// `T_odom_start`: where the base is now.
  Finding at(const Eigen::Isometry2d& T_odom_base, const Eigen::Isometry2d& T_odom_start,
             const Surroundings& surroundings, const std::vector<bool>& touches) const;
  /// Whether a place counts as seen though nobody has looked there: the base stands on it, or it is its blind
  /// zone.
  bool isGranted(const Eigen::Vector2d& p_start) const;

  MotionCheckParams params_;
  control::DriveModelParams drive_;
  std::vector<Eigen::Vector2d> outline_;  ///< points of the rectangle with its margin, base_link
  double circle_m_;                       ///< radius in which the base turns on the spot
};

}  // namespace stereo_nav::navigator
