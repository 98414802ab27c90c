#pragma once

#include <optional>
#include <vector>

#include "kinematics/drive.h"
#include "odometry/wheel/wheel_odometry.h"
#include "stereo_nav/core/trajectory.h"

namespace stereo_nav::calibration {

/// A drive on which the wheels were read and something better followed base_link.
struct WheelRun {
  std::vector<odometry::WheelSample> samples;  ///< in order of time
  Trajectory reference;  ///< of base_link in any fixed frame; its stamps may be off by a constant
};

/// Successive pieces of the runs, in which the motion by the wheels is held against that of the reference.
/// Pieces without motion, and those that the reference does not cover, are left out.
class WheelWindows {
 public:
  struct Window {
    std::size_t run;
    std::size_t first;  ///< index of its first sample
    std::size_t last;   ///< index of its last sample
  };

  /// Pieces of `window_s`, the last of a run at least half as long. The reference covers them with `margin_s`
  /// to spare. `runs` must outlive this object.
  WheelWindows(const odometry::WheelOdometryParams& params, const std::vector<WheelRun>& runs,
               double window_s, double margin_s);

  const std::vector<Window>& windows() const { return windows_; }

  /// Motion in a window by wheels of this geometry.
  struct Motion {
    Eigen::Isometry2d T_start_end;
    /// What each wheel contradicts the others by, rolling and then sideways, in units of what its slip and
    /// its counter explain. Zero without redundancy.
    Eigen::VectorXd contradictions;
  };
  /// Weighs the wheels with the errors of `errors`.
  Motion byWheels(const Window& window, const kinematics::Drive& drive,
                  const odometry::WheelOdometryParams& errors) const;
  /// The same by the reference, whose stamps are late by `offset_s`.
  Eigen::Isometry2d byReference(const Window& window, double offset_s) const;
  /// Covariance of the pose of byWheels(), axes of the window's end, with the errors of `params`.
  Eigen::Matrix3d covariance(const Window& window, const odometry::WheelOdometryParams& params) const;

 private:
  struct Step {
    std::vector<double> pulses;
    std::vector<double> steering_rad;
    double duration_s;
  };

  void cut(std::size_t run, double window_s, double margin_s);
  bool moves(const Window& window) const;
  odometry::WheelInterval intervalOf(const Step& step, const kinematics::DriveParams& drive,
                                     const odometry::WheelOdometryParams& errors) const;

  const std::vector<WheelRun>& runs_;
  std::vector<std::vector<Step>> steps_;  ///< of each run, step i ends at sample i + 1
  std::vector<Window> windows_;
};

}  // namespace stereo_nav::calibration
