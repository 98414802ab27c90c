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

/// Successive turns over at least `interval_s` each; no turn spans two runs.
std::vector<Turn> turnsOf(const std::vector<CameraOrientation>& camera, double interval_s);

/// The IMU's turns over the same intervals.
class ImuTurns {
 public:
  /// `bias_rad_s` is subtracted from the rates.
  ImuTurns(const std::vector<ImuSample>& samples, const Eigen::Vector3d& bias_rad_s);

  /// Returns nothing where the samples do not cover the interval. `offset_s`: by how much the IMU's stamps
  /// are late.
  std::optional<Eigen::Vector3d> turn(const Turn& camera, double offset_s) const;

 private:
  RotationHistory history_;
};

/// The reason why the data cannot be used; empty if they can be.
std::string refuseData(const std::vector<Turn>& turns, const std::vector<ImuSample>& imu,
                       const ImuCameraRotationParams& params);

/// The reason why the result cannot be used; empty if it can be.
std::string refuseResult(const ImuCameraRotation& result, bool mirrored,
                         const ImuCameraRotationParams& params);

}  // namespace stereo_nav::calibration
