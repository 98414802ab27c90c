#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <optional>

namespace stereo_nav::imu {

/// Angular velocity of a stream of attitudes, for modules that send no rates.
class AngularRate {
 public:
  /// `window_s`: the difference is taken over about this time; longer is smoother and later (by half of it).
  explicit AngularRate(double window_s) : window_s_(window_s) {}

  /// rad/s, IMU frame; nothing at the first attitude and after a gap. Times must grow.
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
