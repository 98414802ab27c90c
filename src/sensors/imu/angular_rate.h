#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <optional>

namespace stereo_nav::imu {

/// Angular velocity of a stream of attitudes, for modules that send no rates.
class AngularRate {
 public:
  /// `window_s`: the difference is taken over about this time. A longer window is smoother, and later by half
  /// of its length.
  explicit AngularRate(double window_s) : window_s_(window_s) {}

  /// Returns rad/s in the IMU frame; nothing at the first attitude and after a gap. Times must increase.
  std::optional<Eigen::Vector3d> update(double time_s, const Eigen::Quaterniond& q_world_imu);
  void reset() { history_.clear(); }

 private:
  struct Entry {
    double time_s;
    Eigen::Quaterniond q_world_imu;
  };
  static constexpr double kMaxGap_s = 0.25;

  double window_s_;
  std::deque<Entry> history_;
};

}  // namespace stereo_nav::imu
