#pragma once

#include <optional>

#include "core/rotation_history.h"

namespace stereo_nav::odometry {

/// The yaw of a base at the instants of its wheels, from the samples of its IMU: increments of attitudes
/// where the IMU has them, else integrated rates. Counts from zero and does not wrap.
class ImuYaw {
 public:
  explicit ImuYaw(const Eigen::Matrix3d& R_base_imu) : R_base_imu_(R_base_imu) {}

  /// Samples that are not newer than the last one are left out.
  void add(const ImuSample& sample) { history_.add(sample); }
  /// Stamp of the newest sample, -infinity without any.
  double newest_s() const { return history_.newest_s(); }

  /// To be asked in order of time. Nothing where the samples do not cover the time since the last instant.
  std::optional<double> at(double time_s);

 private:
  Eigen::Matrix3d R_base_imu_;
  RotationHistory history_;
  std::optional<double> last_s_;
  double yaw_rad_ = 0.0;
};

}  // namespace stereo_nav::odometry
