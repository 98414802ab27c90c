#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <optional>

#include "stereo_nav/core/imu_sample.h"

namespace stereo_nav {

/// Recent IMU samples, asked for the rotation between two instants. Attitudes are preferred where the samples
/// carry them (interpolated at both ends); otherwise angular rates are integrated (linear between samples,
/// both ends interpolated). Keeps the seconds it is asked to.
class RotationHistory {
 public:
  static constexpr double kHistory_s = 10.0;
  /// Two samples further apart than this leave a hole that nothing is interpolated across.
  static constexpr double kMaxGap_s = 0.25;

  /// `history_s` may be infinite, for a recording as a whole.
  explicit RotationHistory(double history_s = kHistory_s) : history_s_(history_s) {}

  /// Samples that are not newer than the last one, or not finite, are ignored; returns whether it was taken.
  bool add(const ImuSample& sample);
  void clear() { samples_.clear(); }
  bool empty() const { return samples_.empty(); }
  double newest_s() const;  ///< -infinity when empty

  /// Rotation that takes coordinates of the IMU frame at `from_s` into the IMU frame at `to_s` (either order
  /// of time); nothing when the samples do not cover the interval.
  std::optional<Eigen::Matrix3d> increment(double from_s, double to_s) const;

  /// Attitude (world <- IMU) at an instant, where the samples carry one.
  std::optional<Eigen::Quaterniond> attitude(double time_s) const;

  /// Angular velocity at an instant, rad/s in the IMU frame, where the samples carry one.
  std::optional<Eigen::Vector3d> angularVelocity(double time_s) const;

  /// Mean specific force of the samples in [from_s, to_s], IMU frame, m/s^2; nothing without accelerometer
  /// samples.
  std::optional<Eigen::Vector3d> meanAcceleration(double from_s, double to_s) const;

 private:
  bool covers(double from_s, double to_s) const;
  std::optional<Eigen::Matrix3d> integrateRates(double from_s, double to_s) const;

  double history_s_;
  std::deque<ImuSample> samples_;
};

}  // namespace stereo_nav
