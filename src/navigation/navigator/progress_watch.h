#pragma once

#include <Eigen/Geometry>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::navigator {

/// What counts as progress.
struct ProgressParams {
  double patience_s = 5.0;
  double way_m = 0.2;
  double turn_deg = 20.0;

  void describe(ParameterVisitor& visitor);
};

/// Says when a base that is to move does not. Turning counts as moving: a base that turns on the spot is not
/// stuck.
class ProgressWatch {
 public:
  explicit ProgressWatch(const ProgressParams& params) : params_(params) {}

  /// Starts to watch, anew.
  void restart(double now_s, const Eigen::Isometry2d& T_odom_base);

  /// Whether the base has not moved, by the way or the turn of the parameters, for longer than the patience.
  bool stuck(double now_s, const Eigen::Isometry2d& T_odom_base);

 private:
  ProgressParams params_;
  double since_s_ = 0.0;
  Eigen::Isometry2d T_odom_mark_ = Eigen::Isometry2d::Identity();
};

}  // namespace stereo_nav::navigator
