#pragma once

#include "navigation/control/drive_model.h"

namespace stereo_nav::control {

/// What moves a base along a path: one twist a period.
class Follower {
 public:
  virtual ~Follower() = default;

  /// The command given at `now_s`. `state` is what the odometry said for the time `stamp_s`, in the frame of
  /// the path.
  virtual Twist command(const DriveState& state, double stamp_s, double now_s) = 0;

  /// Whether the base is to stand from now on. It stays so.
  virtual bool finished() const = 0;
};

}  // namespace stereo_nav::control
