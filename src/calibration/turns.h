#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/imu_camera_rotation.h"
#include "core/rotation_history.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::calibration {

/// A turn of the camera over an interval: rotation vector that takes the later frame's coordinates into the
/// earlier one's.
struct Turn {
  double from_s;
  double to_s;
  Eigen::Vector3d angle_rad;
  double duration_s() const { return to_s - from_s; }
};

/// Successive turns of at least `interval_s`, none across two runs.
std::vector<Turn> turnsOf(const std::vector<CameraOrientation>& camera, double interval_s);

/// The IMU's turns over the same intervals.
class ImuTurns {
 public:
  /// `bias_rad_s` is taken off the rates.
  ImuTurns(const std::vector<ImuSample>& samples, const Eigen::Vector3d& bias_rad_s);

  /// Nothing where the samples do not cover the interval. `offset_s`: the IMU's stamps are late by it.
  std::optional<Eigen::Vector3d> turn(const Turn& camera, double offset_s) const;

 private:
  RotationHistory history_;
};

/// Why the data cannot be used; empty if they can be tried.
std::string refuseData(const std::vector<Turn>& turns, const std::vector<ImuSample>& imu,
                       const ImuCameraRotationParams& params);

/// Why the result cannot be used; empty if it can.
std::string refuseResult(const ImuCameraRotation& result, bool mirrored,
                         const ImuCameraRotationParams& params);

}  // namespace stereo_nav::calibration
