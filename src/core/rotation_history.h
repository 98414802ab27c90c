#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <optional>

#include "stereo_nav/core/imu_sample.h"

namespace stereo_nav {

/// Recent IMU samples that give the rotation between two instants. Where the samples carry attitudes, these
/// are used, interpolated at both ends; otherwise angular rates are integrated, taken as linear between
/// samples and interpolated at both ends. The history covers the time given to the constructor.
class RotationHistory {
 public:
  static constexpr double kHistory_s = 10.0;
  /// There is no interpolation between two samples that are further apart than this.
  static constexpr double kMaxGap_s = 0.25;

  /// `history_s` may be infinite, for a recording as a whole.
  explicit RotationHistory(double history_s = kHistory_s) : history_s_(history_s) {}

  /// Adds a sample, unless it is not newer than the last one or not finite. Returns whether it was added.
  bool add(const ImuSample& sample);
  void clear() { samples_.clear(); }
  bool empty() const { return samples_.empty(); }
  double newest_s() const;  ///< -infinity when empty

  /// Rotation that takes coordinates of the IMU frame at `from_s` into the IMU frame at `to_s` (in either
  /// order of time); nothing when the samples do not cover the interval.
  std::optional<Eigen::Matrix3d> increment(double from_s, double to_s) const;

  /// The same rotation of a camera that is fixed to the IMU.
  std::optional<Eigen::Matrix3d> increment(double from_s, double to_s,
                                           const Eigen::Matrix3d& R_camera_imu) const;

  /// Attitude (world <- IMU) at an instant; nothing where the samples carry none.
  std::optional<Eigen::Quaterniond> attitude(double time_s) const;

  /// Angular velocity at an instant, rad/s in the IMU frame; nothing where the samples carry none.
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
