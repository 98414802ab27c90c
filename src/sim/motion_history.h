#pragma once

#include <deque>

#include "kinematics/twist.h"
#include "sim/trajectory.h"

namespace stereo_nav::sim {

/// The latest motion of a driven robot: steps of constant velocity. Copies serve images that are rendered
/// while the robot goes on.
class MotionHistory {
 public:
  /// Steps last `step_s`; the first one begins at time 0 at `T_world_base`. Half a second is kept.
  MotionHistory(const Eigen::Isometry2d& T_world_base, double step_s);

  void add(const kinematics::Twist& twist);
  double time_s() const { return static_cast<double>(done_) * step_s_; }
  /// Pose now.
  const Eigen::Isometry2d& T_world_base() const { return now_; }

  /// At a time of the last half second; beyond that as at its ends.
  Eigen::Isometry3d pose(double time_s) const;
  BaseState state(double time_s) const;

 private:
  struct Step {
    Eigen::Isometry2d T_world_base;  ///< at its beginning
    kinematics::Twist twist;
  };

  /// The step that holds a time, and how much of it has passed.
  std::pair<std::size_t, double> stepAt(double time_s) const;

  double step_s_;
  std::size_t done_ = 0;
  Eigen::Isometry2d now_;
  std::deque<Step> steps_;  ///< the last of those that are done
};

}  // namespace stereo_nav::sim
