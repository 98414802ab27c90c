#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <memory>
#include <vector>

#include "navigation/control/path_driver.h"

namespace stereo_nav::navigator {

/// Where the base came from: the way that it can go back, since it was free a moment ago.
class Trail {
 public:
  /// Keeps the last `most_m` of the way.
  explicit Trail(double most_m) : most_m_(most_m) {}

  /// The place of the base; points lie 2 cm apart. True where it has jumped, because the odometry was set
  /// anew: nothing is known then of the way there.
  bool add(const Eigen::Vector2d& p_odom);

  /// From the base back along its way, `length_m` at most. Fewer than two points where it has not moved.
  std::vector<Eigen::Vector2d> back(double length_m) const;

 private:
  double most_m_;
  std::deque<Eigen::Vector2d> points_;  ///< the newest last
};

/// Follows a path backwards: the base is seen turned by half a turn, and follows it forwards.
class ReverseDriver : public control::Follower {
 public:
  /// `params`: those of driving forwards; a holonomic base backs off as a differential one does.
  ReverseDriver(const control::ControlParams& params, const std::vector<Eigen::Vector2d>& points,
                double speed_m_per_s);

  control::Twist command(const control::DriveState& state, double stamp_s, double now_s) override;
  bool finished() const override { return driver_.finished(); }

 private:
  control::PathDriver driver_;
};

}  // namespace stereo_nav::navigator
